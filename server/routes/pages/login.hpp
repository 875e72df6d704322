#pragma once
#include "server/http/router.hpp"
#include "server/keys/key_ring.hpp"

namespace bahnwerk::server {

/// Answers a page for people without a key, 401: a form that asks for it. `wrong`: the one given is not valid.
Response login_page(const Request& request, bool wrong);

/// Adds POST /login: it exchanges the form's key for a cookie that scripts cannot read and that no other site's page
/// sends; the cookie opens pages and reads, and serves the changes that pages of this service ask for. Adds POST
/// /logout, which removes the cookie.
void add_login_routes(Router& router, const KeyRing& keys);

}  // namespace bahnwerk::server
