#include "server/http/tls.hpp"

#include <openssl/ssl.h>

#include <stdexcept>
#include <string_view>

namespace bahnwerk::server {
namespace {

namespace ssl = boost::asio::ssl;

/// Chooses http/1.1 from what the client offers; a client that offers nothing of it speaks it as well, or finds out.
int choose_protocol(SSL*, const unsigned char** out, unsigned char* size, const unsigned char* offers,
                    unsigned int length, void*) {
  static constexpr unsigned char known[] = "\x08http/1.1";
  unsigned char* chosen = nullptr;
  if (SSL_select_next_proto(&chosen, size, known, sizeof known - 1, offers, length) != OPENSSL_NPN_NEGOTIATED)
    return SSL_TLSEXT_ERR_NOACK;
  *out = chosen;
  return SSL_TLSEXT_ERR_OK;
}

}  // namespace

std::shared_ptr<ssl::context> make_tls(const TlsFiles& files) {
  if (files.certificate.empty()) {
    if (!files.key.empty() || !files.client_ca.empty())
      throw std::runtime_error("--tls-key and --tls-client-ca need --tls-cert");
    return nullptr;
  }
  if (files.key.empty()) throw std::runtime_error("--tls-cert needs the key of the certificate, --tls-key");
  const auto context = std::make_shared<ssl::context>(ssl::context::tls_server);
  boost::system::error_code error;
  const auto check = [&](const char* what, const std::string& file) {
    if (error) throw std::runtime_error("cannot take the " + std::string(what) + " " + file + ": " + error.message());
  };
  SSL_CTX* const native = context->native_handle();
  SSL_CTX_set_min_proto_version(native, TLS1_2_VERSION);
  SSL_CTX_set_options(native, SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION | SSL_OP_CIPHER_SERVER_PREFERENCE);
  SSL_CTX_set_mode(native, SSL_MODE_RELEASE_BUFFERS);
  SSL_CTX_set_alpn_select_cb(native, choose_protocol, nullptr);
  SSL_CTX_set_session_cache_mode(native, SSL_SESS_CACHE_OFF);
  context->use_certificate_chain_file(files.certificate, error);
  check("certificate", files.certificate);
  context->use_private_key_file(files.key, ssl::context::pem, error);
  check("key", files.key);
  if (!files.client_ca.empty()) {
    context->load_verify_file(files.client_ca, error);
    check("authority of clients", files.client_ca);
    context->set_verify_mode(ssl::verify_peer | ssl::verify_fail_if_no_peer_cert);
  }
  return context;
}

}  // namespace bahnwerk::server
