#include "api/schema/schema_explain.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "api/pointer.hpp"
#include "api/text/json_text.hpp"
#include "core/base/progress.hpp"

namespace bahnwerk::api {
namespace {

using nlohmann::json;

std::string number_text(const json& value) {
  std::string text;
  append_number(text, value.get<double>());
  return text;
}

std::string list_text(const json& values) {
  std::string text;
  for (const auto& value : values) text += (text.empty() ? "" : ", ") + value.dump();
  return text;
}

bool is_type(const json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "null") return value.is_null();
  if (type == "integer") return value.is_number_integer();
  return value.is_number();
}

std::string with_article(const std::string& type) {
  if (type == "null") return type;
  return (std::string_view("aeiou").find(type[0]) == std::string_view::npos ? "a " : "an ") + type;
}

class Explainer {
 public:
  Explainer(const json& root, std::size_t most, Progress progress) : root_(root), max_(most), progress_(progress) {}
  std::vector<FieldError> errors;

  void visit(const json& unresolved, const json& value, std::string& at) {
    if (errors.size() >= max_) return;
    if (++values_ % values_per_report == 0) progress_.report("read", 0);
    const json& schema = resolve_ref(root_, unresolved);
    if (schema.is_boolean()) {
      if (!schema.get<bool>()) add(at, "is not allowed here");
      return;
    }
    const std::size_t before = errors.size();
    if (!type(schema, value, at) || !choice(schema, value, at)) return;
    if (value.is_number()) number(schema, value, at);
    if (value.is_string()) string(schema, value.get_ref<const std::string&>(), at);
    if (value.is_array()) array(schema, value, at);
    if (value.is_object()) object(schema, value, at);
    // A choice between forms is dropped if there is a more precise message.
    if (errors.size() == before && schema.contains("oneOf")) one_of(schema["oneOf"], value, at);
  }

 private:
  const json& root_;
  std::size_t max_;
  static constexpr std::size_t values_per_report = 4096;  // 5 ms
  Progress progress_;
  std::size_t values_ = 0;

  void add(const std::string& at, std::string message) {
    if (errors.size() >= max_) return;
    for (const auto& error : errors)
      if (error.pointer == at) return;
    errors.push_back({at, std::move(message)});
  }

  bool type(const json& schema, const json& value, const std::string& at) {
    if (!schema.contains("type")) return true;
    const json& type = schema["type"];
    std::string expected;
    for (const auto& name : type.is_array() ? type : json::array({type})) {
      if (is_type(value, name)) return true;
      expected += (expected.empty() ? "" : " or ") + with_article(name);
    }
    const bool later =
        schema.contains("x-not-available") && contains(schema["x-not-available"], std::string(value.type_name()));
    add(at, (later ? with_article(value.type_name()) + " is not available in this version; must be " : "must be ") +
                expected);
    return false;
  }

  bool choice(const json& schema, const json& value, const std::string& at) {
    if (schema.contains("const") && value != schema["const"]) {
      add(at, "must be " + schema["const"].dump());
      return false;
    }
    if (!schema.contains("enum") || contains(schema["enum"], value)) return true;
    const bool later = schema.contains("x-not-available") && contains(schema["x-not-available"], value);
    add(at, (later ? value.dump() + " is not available in this version; available: " : "must be one of ") +
                list_text(schema["enum"]));
    return false;
  }
  static bool contains(const json& list, const json& value) {
    return std::find(list.begin(), list.end(), value) != list.end();
  }

  void number(const json& schema, const json& value, const std::string& at) {
    const double x = value.get<double>();
    const auto limit = [&](const char* key, auto broken, const char* words) {
      if (schema.contains(key) && broken(x, schema[key].get<double>())) add(at, words + number_text(schema[key]));
    };
    limit("minimum", std::less<>(), "must be at least ");
    limit("maximum", std::greater<>(), "must be at most ");
    limit("exclusiveMinimum", std::less_equal<>(), "must be greater than ");
    limit("exclusiveMaximum", std::greater_equal<>(), "must be less than ");
  }

  void size(const json& schema, const char* low, const char* high, std::size_t n, const char* what,
            const std::string& at) {
    const auto text = [&](const json& limit) {
      const auto count = limit.get<std::size_t>();
      return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
    };
    if (schema.contains(low) && n < schema[low].get<std::size_t>()) add(at, "must have at least " + text(schema[low]));
    if (schema.contains(high) && n > schema[high].get<std::size_t>())
      add(at, "must have at most " + text(schema[high]));
  }

  void string(const json& schema, const std::string& value, const std::string& at) {
    size(schema, "minLength", "maxLength", count_characters(value), "character", at);
  }

  void array(const json& schema, const json& value, std::string& at) {
    size(schema, "minItems", "maxItems", value.size(), "item", at);
    if (!schema.contains("items")) return;
    const std::size_t length = at.size();
    for (std::size_t i = 0; i < value.size() && errors.size() < max_; ++i) {
      append_token(at, std::to_string(i));
      visit(schema["items"], value[i], at);
      at.resize(length);
    }
  }

  void object(const json& schema, const json& value, std::string& at) {
    const std::size_t length = at.size();
    bool later = false, unknown = false;
    for (const auto& [name, member] : value.items()) {
      append_token(at, name);
      if (schema.contains("properties") && schema["properties"].contains(name)) {
        visit(schema["properties"][name], member, at);
      } else if (schema.contains("additionalProperties")) {
        if (schema["additionalProperties"].is_boolean()) {
          if (!schema["additionalProperties"].get<bool>()) {
            const bool known = schema.contains("x-not-available") && contains(schema["x-not-available"], name);
            later |= known;
            unknown = true;
            add(at, (known ? "is not available in this version; available: " : "unknown member; known are ") +
                        names(schema));
          }
        } else {
          visit(schema["additionalProperties"], member, at);
        }
      }
      at.resize(length);
    }
    if (later) return;  // a member that is missing beside a form of a later version is no news
    if (schema.contains("required"))
      for (const auto& name : schema["required"]) {
        const auto& key = name.get_ref<const std::string&>();
        if (value.contains(key)) continue;
        append_token(at, key);
        add(at, "is required");
        at.resize(length);
      }
    if (!unknown) {
      if (schema.value("minProperties", 0) == 1 && schema.value("maxProperties", 0) == 1) {
        if (value.size() != 1) add(at, "must have exactly one member, one of " + names(schema));
      } else {
        size(schema, "minProperties", "maxProperties", value.size(), "member", at);
      }
    }
  }
  static std::string names(const json& schema) {
    std::string text;
    if (schema.contains("properties"))
      for (const auto& [name, member] : schema["properties"].items())
        if (member != json(false)) text += (text.empty() ? "" : ", ") + name;
    return text;
  }

  /// Tells whether a branch of a choice has another type than the value, or another value of a constant member.
  static bool excluded(const json& branch, const json& value) {
    if (branch.contains("const")) return value.type() != branch["const"].type();
    if (branch.contains("type") && branch["type"].is_string() && !is_type(value, branch["type"])) return true;
    if (!branch.contains("properties") || !value.is_object()) return false;
    for (const auto& [name, member] : branch["properties"].items())
      if (member.is_object() && member.contains("const") && value.contains(name) && value[name] != member["const"])
        return true;
    return false;
  }
  static bool complete(const json& branch, const json& value) {
    if (!branch.contains("required")) return true;
    return value.is_object() &&
           std::all_of(branch["required"].begin(), branch["required"].end(),
                       [&](const json& name) { return value.contains(name.get_ref<const std::string&>()); });
  }

  /// Tells whether a branch requires a constant member, by which documents select it, that the value lacks.
  static bool unnamed(const json& branch, const json& value) {
    if (!branch.contains("required") || !branch.contains("properties") || !value.is_object()) return false;
    const json& members = branch["properties"];
    return std::any_of(branch["required"].begin(), branch["required"].end(), [&](const json& required) {
      const auto& name = required.get_ref<const std::string&>();
      return !value.contains(name) && members.contains(name) && members[name].contains("const");
    });
  }

  /// The member by which documents select a branch: all branches have it, as a constant. None: no values.
  struct Selector {
    std::string name = {};
    json values = json::array();
    bool required = true;
  };
  Selector selector(const json& branches) const {
    const auto constant = [](const json& branch, const std::string& name) -> const json* {
      if (!branch.contains("properties") || !branch["properties"].contains(name)) return nullptr;
      const json& member = branch["properties"][name];
      return member.is_object() && member.contains("const") ? &member["const"] : nullptr;
    };
    const json& first = resolve_ref(root_, branches.front());
    if (!first.contains("properties")) return {};
    for (const auto& member : first["properties"].items()) {
      Selector found{member.key()};
      for (const auto& each : branches) {
        const json& branch = resolve_ref(root_, each);
        const json* value = constant(branch, found.name);
        if (value == nullptr) break;
        found.values.push_back(*value);
        found.required &= branch.contains("required") && contains(branch["required"], found.name);
      }
      if (found.values.size() == branches.size()) return found;
    }
    return {};
  }
  /// Tells whether the value lacks the member that selects a branch, or has none of its values; explains that.
  bool unselected(const json& branches, const json& value, std::string& at) {
    const Selector by = value.is_object() ? selector(branches) : Selector{};
    if (by.values.empty()) return false;
    const bool absent = !value.contains(by.name);
    if (absent ? !by.required : contains(by.values, value[by.name])) return false;
    const std::size_t length = at.size();
    append_token(at, by.name);
    add(at, (absent ? "is required: one of " : "must be one of ") + list_text(by.values));
    at.resize(length);
    return true;
  }

  /// Explains the branch that the value means: the one selected by its type or a constant member, else the one that
  /// needs no such member, else the one whose required members are present. If none or several remain, lists the
  /// branches.
  void one_of(const json& branches, const json& value, std::string& at) {
    if (unselected(branches, value, at)) return;
    std::vector<const json*> possible, filled;
    std::size_t valid = 0;
    std::string titles;
    for (const auto& each : branches) {
      const json& branch = resolve_ref(root_, each);
      Explainer inner(root_, 1, progress_);
      inner.values_ = values_;
      inner.visit(branch, value, at);
      values_ = inner.values_;
      valid += inner.errors.empty();
      titles += (titles.empty() ? "" : ", or ") + branch.value("title", std::string("another form"));
      if (excluded(branch, value)) continue;
      possible.push_back(&branch);
      if (complete(branch, value)) filled.push_back(&branch);
    }
    if (valid == 1) return;
    if (possible.size() > 1) {
      std::vector<const json*> named;
      for (const json* branch : possible)
        if (!unnamed(*branch, value)) named.push_back(branch);
      if (named.size() == 1) possible = std::move(named);
    }
    if (possible.size() != 1) possible = filled;
    if (possible.size() == 1)
      visit(*possible.front(), value, at);
    else
      add(at, "must be exactly one of: " + titles);
  }
};

}  // namespace

std::vector<FieldError> explain(const json& schema, const json& document, std::string_view prefix, std::size_t most,
                                Progress progress) {
  Explainer explainer(schema, most, progress);
  std::string at(prefix);
  explainer.visit(schema, document, at);
  return std::move(explainer.errors);
}

}  // namespace bahnwerk::api
