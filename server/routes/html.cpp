#include "server/routes/html.hpp"

#include <openssl/evp.h>

#include "server/http/answer.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::string_view style =
    "body{font:16px/1.5 system-ui,sans-serif;max-width:66rem;margin:2rem auto;padding:0 "
    "1rem;color:#1c2430;background:#fff}"
    "h1{font-size:1.5rem}h2{font-size:1.1rem;margin:2rem 0 .4rem}a{color:#0a58a8}"
    "table{border-collapse:collapse;width:100%}"
    "th,td{text-align:left;vertical-align:top;padding:.3rem .6rem;border-bottom:1px solid #d5dae1}"
    "thead th{border-bottom:2px solid #98a3b3}th.n,td.n{text-align:right}td.n{font-variant-numeric:tabular-nums}"
    "td.k,.state{white-space:nowrap}figure{display:inline-block;margin:0 1rem 1rem 0}"
    "code{font-family:ui-monospace,monospace;font-size:.9em}td a code{font-size:.8em}"
    "nav{margin:-.5rem 0 1rem}.scroll{overflow-x:auto}.lead{font-size:1.15rem}.lead strong{white-space:nowrap}"
    "meter{width:8rem;vertical-align:middle}details{margin:.6rem 0}summary{cursor:pointer}"
    ".line{white-space:nowrap;max-width:24rem;overflow:hidden;text-overflow:ellipsis}"
    ".state{display:inline-block;padding:0 .5rem;border-radius:.3rem;background:#e4e8ee}"
    ".succeeded{background:#d3ecd6;color:#0d4d19}.failed{background:#f9d9d6;color:#7d1109}"
    ".running{background:#d8e7f8;color:#0b3f77}"
    ".error{border-left:4px solid #b3261e;padding:.1rem 1rem;background:#fdf3f2}"
    "img{max-width:100%;max-height:80vh;border:1px solid #d5dae1;background:#fff}progress{width:100%;height:1.2rem}"
    "@media(max-width:40rem){body{margin:1rem auto}table{font-size:.9rem}th,td{padding:.3rem .25rem}"
    "meter{width:3rem}.line{max-width:8rem}}";

/// The time in UTC stays as the tooltip.
constexpr std::string_view script =
    "for(const t of document.querySelectorAll('time'))"
    "{t.title=t.textContent;t.textContent=new "
    "Date(t.dateTime).toLocaleString([],{dateStyle:'short',timeStyle:'medium'})}";

/// Returns the source expression that permits an inline text without 'unsafe-inline'.
std::string hash_source(std::string_view text) {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned int size = 0;
  EVP_Digest(text.data(), text.size(), digest, &size, EVP_sha256(), nullptr);
  unsigned char base64[64] = {};
  EVP_EncodeBlock(base64, digest, static_cast<int>(size));
  return "'sha256-" + std::string(reinterpret_cast<const char*>(base64)) + "'";
}

std::string policy(bool scripted) {
  return "default-src 'none'; img-src 'self'; style-src " + hash_source(style) +
         (scripted ? "; script-src " + hash_source(script) : "") +
         "; frame-ancestors 'none'; base-uri 'none'; form-action 'none'";
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

std::string prose_html(std::string_view text) {
  std::string out;
  bool code = false;
  for (const char c : escape_html(text)) {
    if (c != '`') {
      out += c;
      continue;
    }
    code = !code;
    out += code ? "<code>" : "</code>";
  }
  return code ? out + "</code>" : out;
}

Response html_page(std::string_view title, std::string_view body, int refresh) {
  static const std::string plain_policy = policy(false), scripted_policy = policy(true);
  const bool scripted = body.find("<time ") != std::string_view::npos;
  std::string page =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\">";
  if (refresh > 0) page += "<meta http-equiv=\"refresh\" content=\"" + std::to_string(refresh) + "\">";
  page += "<title>" + escape_html(title) + "</title><style>";
  page.append(style).append("</style></head><body>\n<h1>").append(escape_html(title)).append("</h1>\n");
  page.append(body);
  if (scripted) page.append("<script>").append(script).append("</script>");
  page.append("</body></html>\n");
  Response response = text_answer(200, "text/html; charset=utf-8", std::move(page));
  response.set("Content-Security-Policy", scripted ? scripted_policy : plain_policy);
  return response;
}

}  // namespace bahnwerk::server
