#pragma once
/// The text of a key, bw_ID_SECRET: the id names it in lists and logs, 256 random bits are the secret.
#include <optional>
#include <string>
#include <string_view>

#include "server/store/keys.hpp"

namespace bahnwerk::server {

struct NewKey {
  std::string text;  ///< to be shown once
  Key key;           ///< what is stored: with id and hash, without the rest
};
NewKey make_key();

/// Returns the id in a key's text; nullopt: it is no key.
std::optional<std::string> key_id(std::string_view text);

/// Tells whether this text is that key. Takes the same time whatever the text is.
bool is_key(std::string_view text, const Key& key);

/// Tells whether a key may have this name: 1 to 64 letters, digits and . _ - @.
bool is_key_name(std::string_view name);

}  // namespace bahnwerk::server
