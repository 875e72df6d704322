#pragma once
#include <string>
#include <string_view>

#include "server/http/message.hpp"

namespace bahnwerk::server {

std::string escape_html(std::string_view text);
/// A whole page without any outside asset or script, under a Content-Security-Policy that allows nothing else.
Response html_page(std::string_view title, std::string_view body);

}  // namespace bahnwerk::server
