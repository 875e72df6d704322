#pragma once
/// The one place that decides who may do what.
#include <mutex>
#include <unordered_map>

#include "server/http/router.hpp"
#include "server/keys/key_ring.hpp"
#include "server/runtime/pool.hpp"
#include "server/store/store.hpp"

namespace bahnwerk::server {

/// Name of the cookie in which a browser keeps the key that a person has given it.
inline constexpr std::string_view key_cookie = "bahnwerk_key";

/// Answers 401 without a valid key, 403 without the scope, 404 to who asks for another one's job, as if it were not
/// there. Where there are no keys everyone passes.
class KeyGate final : public Gate {
 public:
  /// `login` answers a person without a key.
  using Login = std::function<Response(const Request&, bool wrong)>;
  KeyGate(const KeyRing& keys, Store& store, Pool& pool, Login login)
      : keys_(keys), store_(store), pool_(pool), login_(std::move(login)) {}
  std::optional<Response> refuse(Access access, Request& request) const override;
  void pass(const RequestPtr& request, const Reply& reply, const Handler& handler) const override;

 private:
  std::optional<std::string> owner_at_hand(const std::string& id) const;
  void keep_owner(const std::string& id, std::string owner) const;
  const KeyRing& keys_;
  Store& store_;
  Pool& pool_;
  const Login login_;
  mutable std::mutex mutex_;
  mutable std::unordered_map<std::string, std::string> owners_;  ///< owners of jobs asked for last; none ever changes
};

/// Returns the name whose jobs the caller sees; nullopt: those of all.
std::optional<std::string> sees_only(const Request& request);

}  // namespace bahnwerk::server
