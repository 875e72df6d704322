#include "large_documents.hpp"

#include <map>
#include <stdexcept>
#include <utility>

#include "tests/api/documents.hpp"

namespace bahnwerk::api::test {
namespace {

struct Entry {
  std::vector<Large> (*large)(double);
  std::vector<Large> (*small)();
};

std::map<std::string, Entry>& entries() {
  static std::map<std::string, Entry> map;
  return map;
}

}  // namespace

KindDocuments::KindDocuments(std::string kind, std::vector<Large> (*large)(double), std::vector<Large> (*small)()) {
  if (!entries().emplace(std::move(kind), Entry{large, small}).second) throw std::logic_error("a kind entered twice");
}

std::vector<Large> large_documents(double size) {
  std::vector<Large> all;
  for (const auto& [kind, entry] : entries())
    for (Large& large : entry.large(size)) all.push_back(std::move(large));
  return all;
}

std::vector<Large> small_documents() {
  std::vector<Large> all;
  for (const auto& [kind, entry] : entries()) {
    if (!entry.small) {
      all.push_back({kind + " minimal", kind, read_json(source("schemas/examples/" + kind + "/minimal.json"))});
      continue;
    }
    for (Large& each : entry.small()) all.push_back(std::move(each));
  }
  return all;
}

}  // namespace bahnwerk::api::test
