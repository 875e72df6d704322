#include "server/routes/html.hpp"

#include <openssl/evp.h>

#include "server/http/answer.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::string_view style =
    "body{font:16px/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 "
    "1rem;color:#1c2430;background:#fff}"
    "table{border-collapse:collapse;width:100%}th,td{text-align:left;padding:.3rem .6rem;border-bottom:1px solid "
    "#d5dae1}"
    "code{font-family:ui-monospace,monospace;font-size:.9em}";

/// The style's hash lets it pass the policy without 'unsafe-inline'.
std::string policy() {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned int size = 0;
  EVP_Digest(style.data(), style.size(), digest, &size, EVP_sha256(), nullptr);
  unsigned char base64[64] = {};
  EVP_EncodeBlock(base64, digest, static_cast<int>(size));
  return "default-src 'none'; style-src 'sha256-" + std::string(reinterpret_cast<const char*>(base64)) +
         "'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'";
}

}  // namespace

std::string escape_html(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

Response html_page(std::string_view title, std::string_view body) {
  static const std::string content_policy = policy();
  std::string page =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>" +
      escape_html(title) + "</title><style>";
  page.append(style).append("</style></head><body>\n<h1>").append(escape_html(title)).append("</h1>\n");
  page.append(body).append("</body></html>\n");
  Response response = text_answer(200, "text/html; charset=utf-8", std::move(page));
  response.set("Content-Security-Policy", content_policy);
  return response;
}

}  // namespace bahnwerk::server
