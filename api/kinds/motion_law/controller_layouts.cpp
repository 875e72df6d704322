#include "api/kinds/motion_law/controller_layouts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "api/text/json_text.hpp"
#include "core/cam/table/controller_table.hpp"

namespace bahnwerk::api {
namespace {

using cam::Between;
using cam::ControllerTable;
using cam::TablePoint;
using nlohmann::json;

/// The law of a stored result, one cycle of it from where the table begins.
struct StoredLaw {
  cam::CamLaw law;
  cam::TableCycle cycle;
  std::string unit, master_unit;

  explicit StoredLaw(const json& result) {
    const json& details = result.at("details");
    const json& master = details.at("master");
    master_unit = master.at("unit").get<std::string>();
    cycle.begin = master.at("begin").get<double>();
    cycle.length = master.at("length").get<double>();
    cycle.duration = result.at("summary").at("cycle_duration").get<double>();
    const double scale = cycle.duration / cycle.length;
    std::vector<double> breaks;
    std::vector<cam::LawPiece> pieces;
    std::size_t number = 0;
    double end = 0;
    for (const json& section : details.at("sections")) {
      for (const json& piece : section.at("pieces")) {
        breaks.push_back(piece.at("begin").get<double>() * scale);
        end = piece.at("end").get<double>() * scale;
        pieces.push_back({number, piece.at("bernstein").get<std::vector<double>>()});
      }
      ++number;
    }
    breaks.push_back(end);
    const cam::CamLaw whole(std::move(breaks), std::move(pieces), master.at("periodic").get<bool>(),
                            master.value("travel", 0.0));
    law = cam::law_from(whole, cycle.begin * scale);
    unit = result.at("setpoints").at("columns").at(1).at("unit").get<std::string>();
  }
};

std::string text_of(double value) {
  std::string out;
  append_number(out, value);
  return out;
}

/// Rows of one separator and one line end.
class Rows {
 public:
  Rows(char separator, const char* line_end) : separator_(separator), line_end_(line_end) {}
  void row(std::initializer_list<std::string> fields) {
    bool first = true;
    for (const std::string& field : fields) {
      if (!first) text_ += separator_;
      first = false;
      text_ += field;
    }
    text_ += line_end_;
  }
  std::string take() { return std::move(text_); }

 private:
  char separator_;
  const char* line_end_;
  std::string text_;
};

/// Type of a point in TwinCAT: 1 rest, 2 velocity, 4 turn, 8 motion.
class PointTypes {
 public:
  explicit PointTypes(const ControllerTable& table) {
    for (const TablePoint& p : table.points)
      velocity_ = std::max(velocity_, std::abs(p.velocity)),
      acceleration_ = std::max(acceleration_, std::abs(p.acceleration));
  }
  std::string operator()(const TablePoint& p) const {
    const bool stands = std::abs(p.velocity) <= 1e-9 * velocity_,
               even = std::abs(p.acceleration) <= 1e-9 * acceleration_;
    return stands ? even ? "1" : "4" : even ? "2" : "8";
  }

 private:
  double velocity_ = 0, acceleration_ = 0;
};

std::string twincat_nc(const ControllerTable& table) {
  Rows rows(';', "\r\n");
  rows.row({"PointIndex", "FunctionType", "PointType", "RelIndexNextPoint", "MasterPos", "SlavePos", "SlaveVelo",
            "SlaveAcc", "SlaveJerk"});
  const PointTypes type(table);
  std::size_t index = 0;
  for (const TablePoint& p : table.points)
    rows.row({std::to_string(++index), p.next == Between::septic ? "24" : "15", type(p), "1", text_of(p.master),
              text_of(p.position), text_of(p.velocity), text_of(p.acceleration), text_of(p.jerk)});
  return rows.take();
}

std::string twincat_mc3(const ControllerTable& table) {
  Rows rows(';', "\r\n");
  rows.row({"FunctionType", "MasterPosition", "SlavePosition", "SlaveVelocity", "SlaveAcceleration", "SlaveJerk",
            "SymmetryRatio", "Ignored"});
  for (const TablePoint& p : table.points)
    rows.row({p.next == Between::septic ? "4" : "3", text_of(p.master), text_of(p.position), text_of(p.velocity),
              text_of(p.acceleration), text_of(p.jerk), "0.5", "FALSE"});
  return rows.take();
}

std::string pairs(const ControllerTable& table, char separator, const char* head) {
  Rows rows(separator, "\n");
  if (head) rows.row({head});
  for (const TablePoint& p : table.points) rows.row({text_of(p.master), text_of(p.position)});
  return rows.take();
}

/// One column of slave positions in 1e-4 of the slave's unit (Tabletype 3), straight lines between them (Functiontype
/// 1); the controller lays them evenly over the master's modulo range and goes from the last one back to the first.
std::string isg(const ControllerTable& table, const std::string& name, const std::string& unit,
                const std::string& error) {
  const std::size_t rows = table.points.size() - 1;
  std::string out =
      "Tablename=" + name + "\r\nTable-ID=1\r\nTabletype=3\r\nFunctiontype=1\r\nLines=" + std::to_string(rows) +
      "\r\n# slave positions in 1e-4 " + unit + ", evenly over the master's cycle from " +
      text_of(table.points.front().master) + "\r\n# differs from the law by: " + error + "\r\nBegintable\r\n";
  for (std::size_t k = 0; k < rows; ++k) out += text_of(1e4 * table.points[k].position) + "\r\n";
  return out + "EndTable\r\n";
}

/// Closes the table of a law whose end is not its begin: the controller goes back within the last step.
void close_table(ControllerTable& table, const cam::TableCycle& cycle) {
  TablePoint& last = table.points.back();
  const double jump = std::abs(table.points.front().position - last.position);
  const double step = cycle.duration / static_cast<double>(table.points.size() - 1);
  last.position = table.points.front().position;
  if (jump <= table.error[0]) return;
  table.error[0] += jump;
  table.error[1] += jump / step;
}

std::string lcamhdl_basic(const ControllerTable& table) {
  Rows rows(',', "\n");
  rows.row({"leadingValue", "followingValue", "velocityRatio", "accelerationRatio"});
  for (const TablePoint& p : table.points)
    rows.row({text_of(p.master), text_of(p.position), text_of(p.velocity), text_of(p.acceleration)});
  return rows.take();
}

/// Polynomials of degree 5 alone: one of degree 7 takes two of the cam's 50 segments, and the controller makes it of
/// two polynomials of degree 6.
std::string lcamhdl_advanced(const ControllerTable& table) {
  Rows rows(',', "\n");
  rows.row({"leadingValueStart", "leadingValueEnd", "followingValueStart", "followingValueEnd", "geoVeloStart",
            "geoVeloEnd", "geoAccelStart", "geoAccelEnd", "geoJerkStart", "geoJerkEnd", "inflectionPointParameter",
            "modVeloTrapezoidParameter", "modSineMaxAccelCaStar", "camProfileType"});
  for (std::size_t k = 0; k + 1 < table.points.size(); ++k) {
    const TablePoint &a = table.points[k], &b = table.ends[k];
    rows.row({text_of(a.master), text_of(b.master), text_of(a.position), text_of(b.position), text_of(a.velocity),
              text_of(b.velocity), text_of(a.acceleration), text_of(b.acceleration), text_of(a.jerk), text_of(b.jerk),
              "0.5", "0", "0", "5"});
  }
  return rows.take();
}

std::string codesys_xyva(const StoredLaw& stored, const ControllerTable& table, const std::string& name,
                         const std::string& error) {
  const std::size_t n = table.points.size();
  std::string out = "(* differs from the law by: " + error + " *)\n";
  if (stored.law.travel() != 0)
    out += "(* in each cycle the slave moves by " + text_of(stored.law.travel()) + " " + stored.unit +
           ": its modulo period divides that, or SlaveAbsolute is FALSE *)\n";
  out += "VAR_GLOBAL\n  " + name + "_A : ARRAY[0.." + std::to_string(n - 1) + "] OF SMC_CAMXYVA := [\n";
  for (std::size_t k = 0; k < n; ++k) {
    const TablePoint& p = table.points[k];
    out += "    (dX := " + text_of(p.master) + ", dY := " + text_of(p.position) + ", dV := " + text_of(p.velocity) +
           ", dA := " + text_of(p.acceleration) + ")" + (k + 1 < n ? ",\n" : "];\n");
  }
  return out + "  " + name + " : MC_CAM_REF := (nElements := " + std::to_string(n) +
         ", byType := 3, xStart := " + text_of(table.points.front().master) +
         ", xEnd := " + text_of(table.points.back().master) + ", nTappets := 0, strCAMName := '" + name +
         "', pce := ADR(" + name + "_A));\nEND_VAR\n";
}

std::string sentence(const ControllerTable& table, const std::string& unit, const std::string& master_unit) {
  const std::array<double, 4>& error = table.error;
  char text[300];
  std::snprintf(text, sizeof text, "position %.3g %s, velocity %.3g %s/s, acceleration %.3g %s/s2, jerk %.3g %s/s3",
                error[0], unit.c_str(), error[1], unit.c_str(), error[2], unit.c_str(), error[3], unit.c_str());
  std::string out = text;
  if (table.steps > 0) {
    std::snprintf(text, sizeof text, "; %zu %s of the law %s at most %.3g %s", table.steps,
                  table.steps == 1 ? "jump" : "jumps", table.steps == 1 ? "takes" : "take", table.longest_step,
                  master_unit.c_str());
    out += text;
  }
  return out;
}

/// The table that a layout holds.
ControllerTable table_for(const StoredLaw& stored, ControllerLayout layout) {
  constexpr std::size_t steps = 1000;
  switch (layout) {
    case ControllerLayout::twincat_nc:
    case ControllerLayout::twincat_mc3:
      return cam::breaks_table(stored.law, stored.cycle, 10000);
    case ControllerLayout::lcamhdl_advanced:
      return cam::breaks_table(stored.law, stored.cycle, 51, false, true);
    case ControllerLayout::codesys_xyva:
      return cam::breaks_table(stored.law, stored.cycle, 1024, false);
    case ControllerLayout::lcamhdl_basic:
      return cam::breaks_table(stored.law, stored.cycle, 51, false);
    case ControllerLayout::lcamhdl_xy:
      return cam::even_table(stored.law, stored.cycle, steps - 1, Between::straight);
    case ControllerLayout::isg: {
      ControllerTable table = cam::even_table(stored.law, stored.cycle, steps, Between::straight);
      close_table(table, stored.cycle);
      return table;
    }
    case ControllerLayout::codesys_xy:
      break;
  }
  return cam::even_table(stored.law, stored.cycle, steps, Between::straight);
}

}  // namespace

ControllerFile controller_file(const json& result, ControllerLayout layout, std::string_view name) {
  const StoredLaw stored(result);
  const ControllerTable table = table_for(stored, layout);
  ControllerFile file;
  file.error = table.error;
  file.refit_error = sentence(table, stored.unit, stored.master_unit);
  file.content_type = "text/plain; charset=utf-8";
  file.extension = "txt";
  const std::string inside(name);
  const auto csv = [&](std::string text) {
    file.text = std::move(text), file.extension = "csv", file.content_type = "text/csv; charset=utf-8; header=present";
  };
  switch (layout) {
    case ControllerLayout::twincat_nc:
      csv(twincat_nc(table));
      break;
    case ControllerLayout::twincat_mc3:
      csv(twincat_mc3(table));
      break;
    case ControllerLayout::isg:
      file.text = isg(table, inside, stored.unit, file.refit_error);
      break;
    case ControllerLayout::lcamhdl_xy:
      csv(pairs(table, ',', "x,y"));
      break;
    case ControllerLayout::lcamhdl_basic:
      csv(lcamhdl_basic(table));
      break;
    case ControllerLayout::lcamhdl_advanced:
      csv(lcamhdl_advanced(table));
      break;
    case ControllerLayout::codesys_xyva:
      file.text = codesys_xyva(stored, table, inside, file.refit_error);
      file.extension = "st";
      break;
    case ControllerLayout::codesys_xy:
      file.text = pairs(table, '\t', nullptr);
      break;
  }
  return file;
}

}  // namespace bahnwerk::api
