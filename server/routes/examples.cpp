#include "server/routes/examples.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "api/pointer.hpp"
#include "api/problem.hpp"
#include "server/http/answer.hpp"
#include "server/http/middleware.hpp"
#include "server/routes/context.hpp"
#include "server/routes/document_check.hpp"
#include "server/runtime/log.hpp"

namespace bahnwerk::server {
namespace {

constexpr std::uintmax_t largest_machine = 1 << 20;  // bytes of a file

std::string read_file(const std::filesystem::path& file) {
  if (std::filesystem::file_size(file) > largest_machine) throw std::runtime_error("it has more than 1 MiB");
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("it cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

void add_own(std::vector<api::MachineFile>& machines, const std::filesystem::path& file) {
  try {
    api::MachineFile own = api::read_machine(file.stem().string(), read_file(file));
    own.own = true;
    std::erase_if(machines, [&](const api::MachineFile& other) { return other.name == own.name; });
    machines.push_back(std::move(own));
  } catch (const std::exception& error) {
    log::error("machine_left_out", {{"file", file.string()}, {"detail", error.what()}});
  }
}

/// Answers a text that stays the same while the process runs, under the hash of its bytes.
Response constant(const Request& request, const std::string& text) {
  require_json(request);
  return unless_known(request, etag_of(text), [&] { return text_answer(200, "application/json", text); });
}

/// Returns a document with a proxy's prefix before the addresses of the entries of `list`.
std::string with_prefix(nlohmann::ordered_json document, const char* list, const Request& request) {
  for (auto& each : document[list]) each["document"] = request.prefix + each["document"].get<std::string>();
  return document.dump();
}

template <class List>
Response one_of(const List& list, const Request& request, const char* what) {
  const std::string& name = request.parameter("name");
  const auto at = std::find_if(list.begin(), list.end(), [&](const auto& each) { return each.name == name; });
  if (at == list.end())
    throw api::Problem("not-found", "There is no " + std::string(what) + " " + api::shortened(name) + "; /v1/" + what +
                                        "s lists them.");
  return constant(request, at->text);
}

}  // namespace

std::vector<api::MachineFile> offered_machines(const std::string& folder) {
  std::vector<api::MachineFile> machines = api::shipped_machines();
  if (folder.empty()) return machines;
  std::vector<std::filesystem::path> files;
  try {
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.is_regular_file() && entry.path().extension() == ".json") files.push_back(entry.path());
  } catch (const std::filesystem::filesystem_error& error) {
    throw std::runtime_error("the folder of machines " + folder + ": " + error.code().message());
  }
  std::sort(files.begin(), files.end());
  for (const auto& file : files) add_own(machines, file);
  std::sort(machines.begin(), machines.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return machines;
}

void add_example_routes(Router& router, Context& context) {
  router.add("POST", "/v1/check", Access::submit,
             [&](const RequestPtr& request, const Reply& reply) { check_document(context, request, reply); });
  router.add("GET", "/v1/examples", Access::any, on_pool(context.pool, [](const Request& request) {
               return constant(request, with_prefix(api::examples_document(), "examples", request));
             }));
  router.add("GET", "/v1/examples/{name}", Access::any,
             on_pool(context.pool, [](const Request& request) { return one_of(api::examples(), request, "example"); }));
  router.add("GET", "/v1/machines", Access::any, on_pool(context.pool, [&](const Request& request) {
               return constant(request, with_prefix(api::machines_document(context.machines), "machines", request));
             }));
  router.add("GET", "/v1/machines/{name}", Access::any, on_pool(context.pool, [&](const Request& request) {
               return one_of(context.machines, request, "machine");
             }));
}

}  // namespace bahnwerk::server
