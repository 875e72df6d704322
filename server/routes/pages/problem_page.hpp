#pragma once
/// Problems as pages, for people who meet them in a browser.
#include "server/http/message.hpp"

namespace bahnwerk::server {

/// Tells whether an Accept header names text/html, and before JSON where it names both: what a browser sends when
/// somebody opens an address. Programs that accept anything get JSON.
bool wants_page(const Request& request);

/// Returns a problem document as a page that says what happened and what to do, with its status and headers.
Response problem_page(const Request& request, const Response& problem);

/// Answers problems as pages to who wants pages; a missing key with the form that asks for it.
Middleware problem_pages();

}  // namespace bahnwerk::server
