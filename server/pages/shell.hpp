#pragma once
/// The frame of every page: head, navigation, policy, tag.
#include <string>
#include <string_view>

#include "server/http/message.hpp"
#include "server/pages/texts.hpp"

namespace bahnwerk::server {

std::string escape_html(std::string_view text);
/// Escapes text and turns text between backquotes into <code>, the notation of the catalogue of problems.
std::string prose_html(std::string_view text);

struct Page {
  std::string title;         ///< heading and title, plain text
  std::string body;          ///< HTML behind the heading
  std::string module;        ///< name of the module in server/web that makes the page alive, e.g. "job"; empty: none
  std::string heading = {};  ///< HTML in place of the title as a heading; empty: the title
};

/// Throws Problem not-acceptable unless the request accepts text/html.
void require_page(const Request& request);

/// Returns a whole page in the language of the request, with style, icon and module of this service alone, under a
/// Content-Security-Policy that allows nothing else: no inline script or style, no outside address, no HTML made of
/// text. The parameter `lang` is remembered in a cookie.
Response html_page(const Request& request, const Page& page);
/// Returns the page with an ETag of its bytes; 304 to who has it.
Response tagged_page(const Request& request, const Page& page);

}  // namespace bahnwerk::server
