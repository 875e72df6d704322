#pragma once
/// The parameters of a part program: #1 … #9999 and named ones, with those that belong to a subprogram.
#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bahnwerk::gcode {

/// What the control keeps: #5161 … #5602, positions and offsets, and predefined names (#<_x>). Nothing else may set
/// them.
class SystemParameters {
 public:
  virtual ~SystemParameters() = default;
  /// None where this reader does not know it.
  virtual std::optional<double> system_parameter(int number) const = 0;
  virtual std::optional<double> predefined(std::string_view name) const = 0;
  /// A name of LinuxCNC whose value only the machine knows.
  virtual bool of_the_machine(std::string_view name) const = 0;
};

class Parameters {
 public:
  static constexpr int most = 9999, locals = 30;  ///< #1 … #30 belong to a subprogram
  static constexpr int position_first = 5021, system_first = 5161, system_last = 5602;
  static constexpr std::size_t max_names = 10'000;  ///< of all subprograms that are under way

  explicit Parameters(const SystemParameters& system) : system_(system) {}

  static bool system(int number) {
    return (number >= position_first && number < position_first + 9) ||
           (number >= system_first && number <= system_last);
  }
  /// 0 where it was never set, or is not known, which is remembered.
  double get(int number, std::size_t line);
  void set(int number, double value);
  /// Names are in small letters, without blanks; those that begin with _ are known everywhere.
  std::optional<double> get(std::string_view name, std::size_t line) const;
  /// Names that the control keeps: predefined ones with a value.
  bool kept(std::string_view name) const;
  bool of_the_machine(std::string_view name) const { return system_.of_the_machine(name); }
  /// False where there are too many.
  bool set(std::string_view name, double value);

  /// A subprogram with its own #1 …, the first of them given, the others as they are; and its own names.
  void enter(const std::vector<double>& arguments);
  void leave();

  struct Unset {
    int number = 0;
    std::size_t line = 0, count = 0;
  };
  const Unset& unset() const { return unset_; }  ///< what was read without a value: the first, and how often

 private:
  using Names = std::map<std::string, double, std::less<>>;
  struct Frame {
    Names names;
    std::array<double, locals> saved;
    std::array<bool, locals> known;
  };
  void reserve();
  Names& names(std::string_view name) {
    return name.substr(0, 1) == "_" || frames_.empty() ? global_ : frames_.back().names;
  }

  const SystemParameters& system_;
  std::vector<double> values_;
  std::vector<bool> known_;
  Names global_;
  std::vector<Frame> frames_;
  std::size_t name_count_ = 0;
  Unset unset_;
};

}  // namespace bahnwerk::gcode
