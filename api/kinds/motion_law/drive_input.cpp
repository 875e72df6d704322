#include "api/kinds/motion_law/drive_input.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/cam_profile/drive_load.hpp"

namespace bahnwerk::api::motion_law {
namespace {

using cam::DriveLoad;
using cam::MotionLawProblem;
using cam::Range;
using nlohmann::json;

constexpr const char* order_names[] = {"position", "velocity", "acceleration", "jerk"};

class Reader {
 public:
  Reader(const json& spec, MotionLawProblem& problem, std::vector<InputFault>& faults, std::vector<std::string>& notes)
      : spec_(spec), problem_(problem), faults_(faults), notes_(notes) {}

  DriveRequest run() {
    if (const auto load = spec_.find("load"); load != spec_.end()) read_load(*load);
    if (const auto drive = spec_.find("drive"); drive != spec_.end()) {
      read_limits(*drive);
      const bool motion = drive->contains("velocity") || drive->contains("acceleration") || drive->contains("jerk");
      if (!motion) problem_.drive.reset();
      if (motion && problem_.cycle_duration) at_given_cycle();
    }
    if (std::isfinite(out_.limits.peak) && out_.load) plan_for_peak();
    return out_;
  }

 private:
  void add(const char* of, const char* member, std::string message) {
    faults_.push_back({{of, member}, std::move(message)});
  }

  void read_load(const json& given) {
    DriveLoad load;
    load.rotary = problem_.slave_unit == "deg";
    load.inertia = given.value(load.rotary ? "inertia" : "mass", 0.0);
    load.force = given.value(load.rotary ? "torque" : "force", 0.0);
    load.spring = given.value("spring", 0.0), load.spring_zero = given.value("spring_zero", 0.0);
    load.damping = given.value("damping", 0.0), load.friction = given.value("friction", 0.0);
    load.ratio = given.value(load.rotary ? "ratio" : "lead", 0.0);
    load.motor_inertia = given.value("motor_inertia", 0.0);
    for (const char* member : {"mass", "force", "lead"})
      if (load.rotary && given.contains(member)) add("load", member, "belongs to a slave that moves in mm");
    for (const char* member : {"inertia", "torque", "ratio"})
      if (!load.rotary && given.contains(member)) add("load", member, "belongs to a slave that moves in deg");
    if (given.contains("motor_inertia") && !load.turns())
      add("load", "motor_inertia", "needs `lead`: the travel per turn of the motor");
    out_.load = load;
  }

  void read_limits(const json& drive) {
    for (const char* member : {"torque", "rms_torque", "force", "rms_force"}) {
      if (!drive.contains(member)) continue;
      const std::string name = member;
      const bool torque = name.ends_with("torque");
      if (!out_.load)
        add("drive", member, "needs `load`: what the drive moves");
      else if (torque != out_.load->turns())
        add("drive", member,
            torque ? "this drive has a force: give `lead` in `load`, or a limit of the force"
                   : "this drive has a torque: give a limit of the torque");
      else
        (name.starts_with("rms") ? out_.limits.rms : out_.limits.peak) = drive.at(member).get<double>();
    }
  }

  void narrow(std::size_t order, Range within, const char* member) {
    out_.section_limits[order] = member;
    for (std::size_t s = 0; s < problem_.sections(); ++s) {
      if (problem_.points[s].law) continue;
      Range& limit = problem_.points[s].section[order];
      limit = {std::max(limit.min, within.min), std::min(limit.max, within.max)};
    }
  }

  void at_given_cycle() {
    out_.given_cycle = problem_.drive;
    problem_.drive.reset();
    if (problem_.method != cam::LawMethod::optimal) return;  // the law is compared with them alone
    const auto& limits = *out_.given_cycle;
    const double most[] = {0, limits.velocity, limits.acceleration, limits.jerk};
    for (std::size_t order = 1; order < 4; ++order)
      if (std::isfinite(most[order])) narrow(order, {-most[order], most[order]}, order_names[order]);
  }

  /// A peak force or torque as a limit of the optimiser.
  void plan_for_peak() {
    const char* member = out_.load->turns() ? "torque" : "force";
    const bool planned = problem_.method == cam::LawMethod::optimal;
    if (!problem_.cycle_duration && (out_.load->spring != 0 || out_.load->damping != 0)) {
      add("drive", member,
          "the shortest cycle within it is not planned for a load with spring or damping: give cycle_duration");
      return;
    }
    const cam::LinearLoad load = cam::linear_load(*out_.load);
    if (out_.load->spring != 0 || out_.load->damping != 0) {
      const double room = out_.limits.peak - load.friction;
      if (!(room > 0))
        add("drive", member, "is taken by the friction alone");
      else if (planned)
        problem_.effort = {{load.position, load.velocity, load.acceleration},
                           {-room - load.constant, room - load.constant}};
      return;
    }
    const Range within = cam::acceleration_within(load, out_.limits.peak);
    if (!(within.min < 0 && within.max > 0)) {
      add("drive", member, "is taken by the constant force and friction alone");
      return;
    }
    if (problem_.cycle_duration) {
      if (planned) narrow(2, within, member);
    } else {
      if (!problem_.drive) problem_.drive.emplace();
      problem_.drive->acceleration = std::min({problem_.drive->acceleration, -within.min, within.max});
    }
  }

  const json& spec_;
  MotionLawProblem& problem_;
  std::vector<InputFault>& faults_;
  std::vector<std::string>& notes_;
  DriveRequest out_;
};

}  // namespace

std::vector<InputFault> blamed_on_drive(const std::vector<InputFault>& faults, const DriveRequest& drive) {
  std::vector<InputFault> out;
  for (InputFault fault : faults) {
    if (fault.place == std::vector<std::string>{"drive", "effort"} && drive.load)
      fault.place[1] = drive.load->turns() ? "torque" : "force";
    for (std::size_t order = 1; order < 4; ++order) {
      const char* member = drive.section_limits[order];
      if (member && fault.place.size() > 3 && fault.place[2] == "section" && fault.place[3] == order_names[order])
        fault.place = {"drive", member};
    }
    const bool known = std::any_of(out.begin(), out.end(), [&](const InputFault& f) { return f.place == fault.place; });
    if (!known || fault.place.front() != "drive") out.push_back(std::move(fault));
  }
  return out;
}

DriveRequest read_drive(const json& spec, MotionLawProblem& problem, std::vector<InputFault>& faults,
                        std::vector<std::string>& notes) {
  return Reader(spec, problem, faults, notes).run();
}

}  // namespace bahnwerk::api::motion_law
