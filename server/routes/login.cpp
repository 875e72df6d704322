#include "server/routes/login.hpp"

#include "api/problem.hpp"
#include "server/http/answer.hpp"
#include "server/http/key_gate.hpp"
#include "server/http/uri.hpp"
#include "server/pages/shell.hpp"

namespace bahnwerk::server {
namespace {

/// Returns a path of this service, where the browser goes on; "/" in place of anything else.
std::string local_path(const std::string& text) {
  const bool local = text.starts_with('/') && !text.starts_with("//") && text.find('\\') == std::string::npos &&
                     text.find_first_of("\r\n") == std::string::npos && parse_target(text).has_value();
  return local ? text : "/";
}

Response form(const Request& request, const std::string& to, bool wrong) {
  const std::string note = wrong ? "<p class=\"error\">This key is not valid.</p>\n" : "";
  Response response =
      html_page(request, {.title = "Bahnwerk",
                          .body = note +
                                  "<form method=\"post\" action=\"/login\"><p>Jobs are shown to whoever has a key: "
                                  "<input type=\"password\" name=\"key\" autocomplete=\"current-password\" required "
                                  "autofocus> <input type=\"hidden\" name=\"to\" value=\"" +
                                  escape_html(to) + "\"><button>Show</button></p></form>\n",
                          .module = "plain"});
  response.set("Cache-Control", "no-store");
  response.set("WWW-Authenticate",
               std::string("Bearer realm=\"bahnwerk\"") + (wrong ? ", error=\"invalid_token\"" : ""));
  response.status = 401;
  response.problem = api::Problem("unauthorized", "").type().slug;
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
  Response response;
  response.status = 303;
  response.set("Location", to);
  response.set("Cache-Control", "no-store");
  response.set("Set-Cookie", std::string(key_cookie) + "=" + key + "; Path=" + request.prefix +
                                 "/; HttpOnly; SameSite=Strict" + (request.secure ? "; Secure" : ""));
  return response;
}

}  // namespace

Response login_page(const Request& request, bool wrong) {
  // A program that asks for a page gets a problem as from everywhere else.
  if (request.header("accept").value_or("").find("text/html") == std::string::npos)
    return problem_answer(api::Problem("unauthorized", "This service needs a key."), request.target)
        .set("WWW-Authenticate", "Bearer realm=\"bahnwerk\"");
  return form(request, local_path(request.target), wrong);
}

void add_login_routes(Router& router, const KeyRing& keys) {
  router.add("POST", "/login", Access::open, [&keys](const RequestPtr& request, const Reply& reply) {
    reply_with(*request, reply, [&] { return login(keys, *request); });
  });
}

}  // namespace bahnwerk::server
