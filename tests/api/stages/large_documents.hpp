#pragma once
/// Large documents of every kind, whose every stage has work to do. Each kind enters its own in large_<kind>.cpp.
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

namespace bahnwerk::api::test {

struct Large {
  std::string name, kind;
  nlohmann::json spec;
  /// Whether a document four times as large has more reports: false for searches that do not take longer.
  bool reports_grow = false;
};

/// Returns the document as it would be posted.
inline std::string job(const Large& large) { return nlohmann::json{{"kind", large.kind}, {"spec", large.spec}}.dump(); }

inline void PrintTo(const Large& large, std::ostream* out) { *out << large.name; }

/// The documents of one kind; an object of this type, with a static lifetime, enters them.
struct KindDocuments {
  /// `large` returns large documents; for a `size` below 1, in the same order, smaller ones of the same form. `small`
  /// returns documents that are planned within some 50 ms; null: the kind's example minimal.json.
  KindDocuments(std::string kind, std::vector<Large> (*large)(double size), std::vector<Large> (*small)() = nullptr);
};

/// Returns the large documents of all kinds, ordered by kind.
std::vector<Large> large_documents(double size = 1);
/// Returns the small documents of all kinds, ordered by kind.
std::vector<Large> small_documents();

}  // namespace bahnwerk::api::test
