#pragma once
#include <string>
#include <string_view>

#include "server/http/message.hpp"

namespace bahnwerk::server {

std::string escape_html(std::string_view text);
/// The same, and what stands between backquotes becomes <code>: the notation of the catalogue of problems.
std::string prose_html(std::string_view text);
/// A whole page without any outside asset or script, under a Content-Security-Policy that allows nothing but its own
/// style and pictures of this service. With `refresh` > 0 the browser loads it again after so many seconds.
Response html_page(std::string_view title, std::string_view body, int refresh = 0);

}  // namespace bahnwerk::server
