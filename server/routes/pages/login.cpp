#include "server/routes/pages/login.hpp"

#include "api/problem.hpp"
#include "server/http/answer.hpp"
#include "server/http/key_gate.hpp"
#include "server/http/uri.hpp"
#include "server/pages/shell.hpp"
#include "server/routes/pages/problem_page.hpp"

namespace bahnwerk::server {
namespace {

/// Returns a path of this service, where the browser goes on; "/" in place of anything else.
std::string local_path(const std::string& text) {
  const bool local = text.starts_with('/') && !text.starts_with("//") && text.find('\\') == std::string::npos &&
                     text.find_first_of("\r\n") == std::string::npos && parse_target(text).has_value();
  return local ? text : "/";
}

Response form(const Request& request, const std::string& to, bool wrong) {
  const Texts text(language_of(request));
  const std::string note =
      wrong ? "<p class=\"error\" role=\"alert\">" + escape_html(text("login.wrong")) + "</p>\n" : "";
  Response response = html_page(
      request,
      {.title = text("login.title"),
       .body = "<p>" + escape_html(text("login.says")) + "</p>\n" + note +
               "<form class=\"login\" method=\"post\" action=\"/login\"><label for=\"key\">" +
               escape_html(text("login.key")) +
               "</label> <input id=\"key\" type=\"password\" name=\"key\" autocomplete=\"current-password\" required "
               "autofocus> <input type=\"hidden\" name=\"to\" value=\"" +
               escape_html(to) + "\"><button class=\"primary\">" + escape_html(text("login.log_in")) +
               "</button></form>\n<p class=\"soft\">" + escape_html(text("login.stays")) + "</p>\n",
       .module = "plain"});
  response.set("Cache-Control", "no-store");
  response.set("WWW-Authenticate",
               std::string("Bearer realm=\"bahnwerk\"") + (wrong ? ", error=\"invalid_token\"" : ""));
  response.status = 401;
  response.problem = api::Problem("unauthorized", "").type().slug;
  return response;
}

/// Sends the browser on to `to`, with a cookie of so many seconds; nullopt: until the browser ends.
Response enter(const Request& request, const std::string& to, const std::string& key, std::optional<int> seconds) {
  Response response;
  response.status = 303;
  response.set("Location", to);
  response.set("Cache-Control", "no-store");
  response.set("Set-Cookie", std::string(key_cookie) + "=" + key + "; Path=" + request.prefix +
                                 "/; HttpOnly; SameSite=Strict" + (request.secure ? "; Secure" : "") +
                                 (seconds ? "; Max-Age=" + std::to_string(*seconds) : ""));
  return response;
}

Response login(const KeyRing& keys, const Request& request) {
  constexpr std::string_view type = "application/x-www-form-urlencoded";
  constexpr std::size_t longest = 4096;
  if (!request.header("content-type").value_or("").starts_with(type))
    throw api::Problem("unsupported-media-type", "A key is posted here as a form: " + std::string(type) + ".");
  const auto fields = request.body.size() <= longest ? parse_target("/?" + request.body) : std::nullopt;
  if (!fields) throw api::Problem("bad-request", "The form is malformed.");
  std::string key, to = "/";
  for (const auto& [name, value] : fields->query) {
    if (name == "key") key = value;
    if (name == "to") to = local_path(value);
  }
  if (!keys.find(key)) return form(request, to, true);
  return enter(request, to, key, std::nullopt);
}

}  // namespace

Response login_page(const Request& request, bool wrong) {
  // A program that asks for a page gets a problem as from everywhere else.
  if (!wants_page(request))
    return problem_answer(api::Problem("unauthorized", "This service needs a key."), request.target)
        .set("WWW-Authenticate", "Bearer realm=\"bahnwerk\"");
  return form(request, request.method == "GET" ? local_path(request.target) : "/", wrong);
}

void add_login_routes(Router& router, const KeyRing& keys) {
  router.add("POST", "/login", Access::open, [&keys](const RequestPtr& request, const Reply& reply) {
    reply_with(*request, reply, [&] { return login(keys, *request); });
  });
  router.add("POST", "/logout", Access::open,
             [](const RequestPtr& request, const Reply& reply) { reply(enter(*request, "/", "", 0)); });
}

}  // namespace bahnwerk::server
