#include "server/pages/shell.hpp"

#include <array>

#include "api/problem.hpp"
#include "server/http/accept.hpp"
#include "server/http/answer.hpp"
#include "server/http/etag.hpp"
#include "server/keys/key_ring.hpp"
#include "server/pages/assets.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::string_view policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob:; connect-src 'self'; "
    "form-action 'self'; frame-ancestors 'none'; base-uri 'none'; require-trusted-types-for 'script'";

/// The address of this page in another language: the other parameters stay.
std::string in_language(const Request& request, Language language) {
  const std::string target = request.target.substr(0, request.target.find('#'));
  const std::size_t mark = target.find('?');
  std::string address = target.substr(0, mark) + "?";
  if (mark != target.npos)
    for (std::size_t at = mark + 1; at < target.size();) {
      const std::size_t end = std::min(target.find('&', at), target.size());
      if (const std::string part = target.substr(at, end - at); !part.empty() && !part.starts_with("lang="))
        address += part + "&";
      at = end + 1;
    }
  return address + "lang=" + std::string(code(language));
}

std::string navigation(const Request& request, const Texts& text) {
  std::string html = "<header><nav><a class=\"brand\" href=\"/\">Bahnwerk</a>";
  const auto link = [&](const char* address, const char* key) {
    const bool here = request.path == address;
    html += " <a href=\"" + std::string(address) + "\"" + (here ? " aria-current=\"page\"" : "") + ">" +
            escape_html(text(key)) + "</a>";
  };
  link("/", "shell.jobs");
  link("/new", "shell.new");
  link("/compare", "shell.compare");
  html += "</nav><nav class=\"languages\">";
  for (const auto language : {Language::en, Language::de}) {
    const bool here = language == text.language();
    html += std::string(language == Language::en ? "" : " ") + "<a lang=\"" + std::string(code(language)) +
            "\" hreflang=\"" + std::string(code(language)) + "\" href=\"" +
            escape_html(in_language(request, language)) + "\"" + (here ? " aria-current=\"true\"" : "") + ">" +
            (language == Language::en ? "English" : "Deutsch") + "</a>";
  }
  html += "</nav>";
  if (request.key)
    html += "<form class=\"log-out\" method=\"post\" action=\"/logout\"><button title=\"" +
            escape_html(text("login.as", {{"name", request.key->key.name}})) + "\">" +
            escape_html(text("login.log_out")) + "</button></form>";
  return html + "</header>\n";
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

void require_page(const Request& request) {
  static constexpr std::array<std::string_view, 1> offers{"text/html"};
  if (!negotiate(request.header("accept"), offers))
    throw api::Problem("not-acceptable", "This page comes as text/html.");
}

Response html_page(const Request& request, const Page& page) {
  const Texts text(language_of(request));
  const std::string title = escape_html(page.title);
  std::string html = "<!doctype html>\n<html lang=\"" + std::string(code(text.language())) +
                     "\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\"><title>" +
                     title + (page.title == "Bahnwerk" ? "" : " · Bahnwerk") + "</title><link rel=\"icon\" href=\"" +
                     asset_address("favicon.svg") + "\"><link rel=\"stylesheet\" href=\"" + asset_address("style.css") +
                     "\">";
  if (!page.module.empty())
    html += "<script type=\"module\" src=\"" + asset_address(page.module + ".js") + "\"></script>";
  // Modules put the proxy's prefix, which is this attribute, before their own addresses.
  html += "</head><body data-base=\"/\">\n" + navigation(request, text) + "<main>\n" +
          (page.heading.empty() ? "<h1><bdi>" + title + "</bdi></h1>\n" : page.heading);
  html.append(page.body).append("</main></body></html>\n");
  Response response = text_answer(200, "text/html; charset=utf-8", std::move(html));
  response.set("Content-Security-Policy", std::string(policy));
  response.set("Cache-Control", "no-cache");
  response.set("Vary", "Accept-Language, Cookie");
  response.set("Referrer-Policy", "same-origin");
  for (const auto& [name, value] : request.query)
    if (name == "lang" && value == code(text.language()))
      response.set("Set-Cookie", "bahnwerk_lang=" + value + "; Path=" + request.prefix +
                                     "/; SameSite=Lax; Max-Age=31536000" + (request.secure ? "; Secure" : ""));
  return response;
}

Response tagged_page(const Request& request, const Page& page) {
  Response response = html_page(request, page);
  const std::string etag = etag_of(response.body);
  return with_etag(request, etag, std::move(response));
}

}  // namespace bahnwerk::server
