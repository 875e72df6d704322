#pragma once
/// The parameters of a part program: #1 … #9999 and named ones, with the local ones of subprograms.
#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bahnwerk::gcode {

/// Parameters of the control: #5161 … #5602, positions and offsets, and predefined names (#<_x>). Programs cannot set
/// them.
class SystemParameters {
 public:
  virtual ~SystemParameters() = default;
  /// Returns nothing if this reader does not know the parameter.
  virtual std::optional<double> system_parameter(int number) const = 0;
  virtual std::optional<double> predefined(std::string_view name) const = 0;
  /// Returns whether it is a name of LinuxCNC whose value only the machine knows.
  virtual bool of_the_machine(std::string_view name) const = 0;
};

/// The parameters of a program, with those that subprograms save.
class Parameters {
 public:
  static constexpr int most = 9999, locals = 30;  ///< #1 … #30 belong to a subprogram
  static constexpr int position_first = 5021, system_first = 5161, system_last = 5602;
  static constexpr std::size_t max_names = 10'000;  ///< largest number of names in all active subprograms together

  explicit Parameters(const SystemParameters& system) : system_(system) {}

  static bool system(int number) {
    return (number >= position_first && number < position_first + 9) ||
           (number >= system_first && number <= system_last);
  }
  /// Returns 0 for a parameter that was never set or is unknown, and records the read.
  double get(int number, std::size_t line);
  void set(int number, double value);
  /// Names are in lower case without blanks; those that begin with _ are global.
  std::optional<double> get(std::string_view name, std::size_t line) const;
  /// Returns whether the name belongs to the control: predefined ones with a value.
  bool kept(std::string_view name) const;
  bool of_the_machine(std::string_view name) const { return system_.of_the_machine(name); }
  /// Returns false if there are too many names.
  bool set(std::string_view name, double value);

  /// Enters a subprogram with its own #1 …, the first ones given by `arguments`, the others copied, and with its own
  /// names.
  void enter(const std::vector<double>& arguments);
  void leave();

  struct Unset {
    int number = 0;
    std::size_t line = 0, count = 0;
  };
  /// Returns the parameters that were read without a value: the first one, and their count.
  const Unset& unset() const { return unset_; }

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
