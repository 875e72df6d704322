#include "server/keys/key_text.hpp"

#include <openssl/crypto.h>
#include <openssl/rand.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "server/runtime/sha256.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::string_view prefix = "bw_";
constexpr std::size_t id_size = 8;       ///< hexadecimal digits
constexpr std::size_t secret_size = 64;  ///< hexadecimal digits

std::string random_hex(std::size_t digits) {
  std::array<unsigned char, secret_size / 2> bytes{};
  if (RAND_bytes(bytes.data(), static_cast<int>(digits / 2)) != 1) throw std::runtime_error("no random numbers");
  std::string out;
  for (std::size_t i = 0; i < digits / 2; ++i) {
    out += "0123456789abcdef"[bytes[i] >> 4];
    out += "0123456789abcdef"[bytes[i] & 15];
  }
  return out;
}

}  // namespace

NewKey make_key() {
  NewKey made;
  made.key.id = random_hex(id_size);
  made.text = std::string(prefix) + made.key.id + "_" + random_hex(secret_size);
  made.key.hash = sha256(made.text);
  return made;
}

std::optional<std::string> key_id(std::string_view text) {
  constexpr std::size_t size = prefix.size() + id_size + 1 + secret_size;
  if (text.size() != size || !text.starts_with(prefix) || text[prefix.size() + id_size] != '_') return std::nullopt;
  return std::string(text.substr(prefix.size(), id_size));
}

bool is_key(std::string_view text, const Key& key) {
  const std::string hash = sha256(text);
  return hash.size() == key.hash.size() && CRYPTO_memcmp(hash.data(), key.hash.data(), hash.size()) == 0;
}

bool is_key_name(std::string_view name) {
  const auto usual = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
           c == '-' || c == '@';
  };
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), usual);
}

}  // namespace bahnwerk::server
