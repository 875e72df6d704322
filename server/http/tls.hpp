#pragma once
/// What TLS needs of a server: certificate, key, and whose clients it accepts.
#include <boost/asio/ssl/context.hpp>
#include <memory>

#include "server/http/listener.hpp"

namespace bahnwerk::server {

/// Reads the files; nullptr without a certificate. TLS 1.2 and 1.3, HTTP/1.1 by ALPN. Throws std::runtime_error with a
/// sentence for the operator.
std::shared_ptr<boost::asio::ssl::context> make_tls(const TlsFiles& files);

}  // namespace bahnwerk::server
