#pragma once
#include <string>
#include <string_view>

#include "server/http/message.hpp"

namespace bahnwerk::server {

std::string escape_html(std::string_view text);
/// Escapes text and turns text between backquotes into <code>, the notation of the catalogue of problems.
std::string prose_html(std::string_view text);
/// Returns a whole page without outside assets, under a Content-Security-Policy that allows only its own style and
/// pictures of this service. A body with elements <time> has the one script that there is, which writes them in local
/// time; the policy allows it by its hash. With `refresh` > 0 the browser reloads it after that many seconds.
Response html_page(std::string_view title, std::string_view body, int refresh = 0);

}  // namespace bahnwerk::server
