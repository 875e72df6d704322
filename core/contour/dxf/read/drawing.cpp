#include "core/contour/dxf/read/drawing.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/contour/builder.hpp"
#include "core/contour/dxf/read/binary.hpp"
#include "core/contour/dxf/read/entity.hpp"
#include "core/contour/dxf/read/file.hpp"
#include "core/contour/dxf/read/layers.hpp"

namespace bahnwerk {
namespace {

constexpr std::size_t max_faults = 100;
constexpr std::size_t max_depth = 32;
constexpr const char* in_paper_space = "skipped: in paper space";

/// An entity of a block, stored for further insertions of the block.
struct Entity {
  std::string_view type;
  std::size_t line = 0;
  DxfCommon common;
  DxfShape shape;
  DxfInsert insert;
};

class Reader {
 public:
  Reader(std::string_view text, const DxfReading& reading, Progress progress)
      : tags_(text, progress), reading_(reading), layers_(reading.layers) {}

  DxfDrawing read() {
    file_ = dxf_file(tags_);
    layers_.declare(file_);
    drawing_.notes = file_.notes;
    const Affine to_mm = scale();
    try {
      entities(*file_.entities, to_mm);
      if (drawing_.strands.empty() && !left_out_ && faults_.empty()) paper_space(to_mm);
    } catch (const InvalidInput& e) {  // reading cannot continue
      faults_.insert(faults_.end(), e.faults.begin(), e.faults.end());
    }
    if (faults_.empty()) faults_ = layers_.missing();
    if (!faults_.empty()) {
      if (faults_.size() > max_faults) faults_.resize(max_faults);
      throw InvalidInput(std::move(faults_));
    }
    report();
    return std::move(drawing_);
  }

 private:
  /// Properties that an INSERT applies to its entities.
  struct Inherited {
    std::string_view layer;  ///< layer of entities on layer 0; empty at the top
    bool off = false;        ///< whether that layer is switched off
  };
  struct Occurrence {
    std::size_t count = 0, line = 0;
  };

  Affine scale() {
    double unit = 1;
    if (reading_.millimetres_per_unit) {
      unit = *reading_.millimetres_per_unit;
    } else if (file_.unit == 0) {
      drawing_.notes.emplace_back("the drawing does not say its unit ($INSUNITS): mm were taken");
    } else if (const auto known = dxf_unit(file_.unit)) {
      unit = *known;
    } else {
      refuse_dxf(file_.unit_line, "$INSUNITS " + std::to_string(file_.unit) + " is no unit to move along in");
    }
    return {{unit, 0, 0}, {0, unit, 0}, {0, 0, unit}, {}};
  }

  /// The entities of model space, or with paper_ those of paper space, from here to the end of the section or block.
  void entities(DxfTags::Mark first, const Affine& to_mm) {
    tags_.seek(first);
    DxfRecord record;
    while (faults_.size() < max_faults && tags_.next(record) && record.type != "ENDSEC" && record.type != "ENDBLK" &&
           record.type != "EOF") {
      count();
      std::vector<Entity> parts;
      parse(record, true, parts);
      for (Entity& entity : parts) draw(std::move(entity), to_mm, {}, 0);
    }
  }

  /// Reads a drawing that was made on a sheet: its model space holds no curve at all. The sheet shown last stands among
  /// the entities, the others are blocks; the first one that holds something is read.
  void paper_space(const Affine& to_mm) {
    std::map<std::size_t, std::pair<std::string, DxfTags::Mark>> sheets;  // keys are lines
    for (const auto& [name, place] : file_.blocks)
      if (name.starts_with("*paper_space")) sheets.emplace(place.line, std::pair{name, place.first});
    space_ = Space::paper;
    blocks_.clear();  // cleared so that their entities in paper space are read, too
    const auto model = noted_;
    const auto holds_something = [&](DxfTags::Mark first, const std::string& name) {
      noted_ = model;
      noted_.erase(in_paper_space);
      entities(first, to_mm);
      if (!drawing_.strands.empty())
        drawing_.notes.push_back("model space is empty: " + name + " was read, in the drawing's unit");
      return !drawing_.strands.empty() || left_out_;
    };
    if (holds_something(*file_.entities, "paper space")) return;
    space_ = Space::sheet;
    for (const auto& [line, sheet] : sheets)
      if (holds_something(sheet.second, "the sheet " + dxf_quoted(sheet.first) + " of paper space")) return;
    noted_ = model;
  }

  void fault(InputFault f) { faults_.push_back(std::move(f)); }
  void note(const std::string& what, std::size_t line) {
    Occurrence& o = noted_[what];
    if (o.count++ == 0) o.line = line;
  }

  /// Counts every step of the work, so that neither cancelling nor blocks in blocks in blocks take long.
  void count() { tags_.progress().work(4); }

  bool has_curves(std::string_view type) const { return dxf_has_curves(type) || (type == "HATCH" && reading_.hatch); }

  /// Adds what is drawn. Faults are collected, but not those in what the top level does not show.
  void parse(const DxfRecord& record, bool top, std::vector<Entity>& parts) {
    Entity entity;
    entity.type = record.type;
    entity.line = record.line;
    try {
      entity.common = dxf_common(record);
      if (space_ == Space::model && entity.common.paper) {
        note(in_paper_space, record.line);
      } else if (space_ == Space::paper && top && !entity.common.paper) {
        return;  // noted when model space was read
      } else if (entity.common.invisible) {
        left_out_ |= record.type == "INSERT" || has_curves(record.type);
        note("skipped: invisible", record.line);
      } else if (record.type == "INSERT") {
        entity.insert = dxf_insert(record);
        parts.push_back(std::move(entity));
      } else if (has_curves(record.type)) {
        if (top && !shown(entity, {})) return;
        std::vector<DxfShape> shapes;
        if (record.type == "HATCH")
          shapes = dxf_hatch(record, tags_);
        else
          shapes.push_back(dxf_shape(record, tags_));
        for (DxfShape& shape : shapes) {
          if (!shape.note.empty()) note(shape.note, record.line);
          entity.shape = std::move(shape);
          parts.push_back(entity);
        }
      } else if (record.type != "SEQEND" && record.type != "VERTEX") {
        const std::string name = dxf_quoted(record.type);
        note("skipped: " + name.substr(1, name.size() - 2) + " is nothing to move along", record.line);
      }
    } catch (const InvalidInput& e) {
      faults_.insert(faults_.end(), e.faults.begin(), e.faults.end());
    }
  }

  /// The layer that counts for an entity, and whether it is switched off.
  Inherited layer_of(const Entity& entity, const Inherited& inherited) {
    if (entity.common.layer == "0" && !inherited.layer.empty()) return inherited;
    return {entity.common.layer, layers_[entity.common.layer].state.off};
  }

  /// Returns whether the entity is shown; adds a note if not. For an INSERT only a frozen layer hides everything.
  bool shown(const Entity& entity, const Inherited& inherited) {
    const Inherited own = layer_of(entity, inherited);
    const DxfLayers::Layer& layer = layers_[own.layer];
    if (layer.state.frozen) {
      left_out_ = true;
      note("skipped: on a frozen layer, " + dxf_quoted(own.layer), entity.line);
      return false;
    }
    if (entity.type == "INSERT") return true;
    if (own.off) note("skipped: on a layer switched off, " + dxf_quoted(own.layer), entity.line);
    if (layer.state.unplotted) note("skipped: on a layer that is not plotted, " + dxf_quoted(own.layer), entity.line);
    const bool visible = !own.off && !layer.state.unplotted && layer.wanted;
    left_out_ |= !visible;
    return visible;
  }

  void draw(Entity entity, const Affine& map, const Inherited& inherited, std::size_t depth) {
    if (depth > 0 || entity.type == "INSERT")
      if (!shown(entity, inherited)) return;
    if (entity.type == "INSERT")
      insert(entity, map, layer_of(entity, inherited), depth);
    else
      place(std::move(entity.shape), entity.line, map);
  }

  /// Converts a curve into mm and adds it to the drawing.
  void place(DxfShape shape, std::size_t line, const Affine& map) {
    dropped_ += shape.without_length;
    if (dropped_line_ == 0 && shape.without_length > 0) dropped_line_ = line;
    DxfStrand strand{{}, line};
    strand.curves.reserve(shape.curves.size());
    // Parts without length are left out; where they would add up to a length, the next part begins at the end of the
    // last one used.
    for (Drawn& curve : shape.curves) {
      tags_.progress().work();
      Drawn placed = straightened(mapped(map, std::move(curve)), line);
      if (!within_range(placed)) return fault(dxf_fault(line, "a coordinate is beyond 1e9 mm"));
      if (auto* straight = std::get_if<DrawnLine>(&placed); straight && !strand.curves.empty())
        if (const Vec end = last_point(strand.curves.back()); norm(straight->from - end) <= min_segment_length)
          straight->from = end;
      if (extent(placed) < min_segment_length) {
        ++dropped_;
        if (dropped_line_ == 0) dropped_line_ = line;
      } else {
        strand.curves.push_back(std::move(placed));
      }
    }
    for (const Drawn& curve : strand.curves) {
      const auto* spline = std::get_if<DrawnSpline>(&curve);
      curves_ += spline == nullptr ? 1 : spline->points.size() - spline->degree;
    }
    if (curves_ > reading_.max_curves)
      refuse_dxf(line, "more than " + std::to_string(reading_.max_curves) + " curves in the drawing");
    if (!strand.curves.empty()) drawing_.strands.push_back(std::move(strand));
  }

  /// An arc whose centre lies beyond all coordinates is a straight line, to 1e-3 mm, or a fault.
  Drawn straightened(Drawn curve, std::size_t line) {
    constexpr double largest_radius = 4e8, sagitta = 1e-3;
    const auto* arc = std::get_if<DrawnArc>(&curve);
    if (arc == nullptr || !(norm(arc->a) > largest_radius)) return curve;
    const Vec from = first_point(curve), to = last_point(curve);
    if (!arc->circular() || !(norm(arc->a) * arc->sweep * arc->sweep / 8 <= sagitta))
      refuse_dxf(line, "a radius is beyond 4e8 mm");
    return DrawnLine{from, to};
  }

  void insert(const Entity& entity, const Affine& map, const Inherited& inherited, std::size_t depth) {
    const DxfInsert& at = entity.insert;
    const auto found = file_.blocks.find(dxf_lower(at.block));
    if (found == file_.blocks.end())
      return fault(dxf_fault(entity.line, "the INSERT names a block that does not exist, " + dxf_quoted(at.block)));
    if (found->second.external) return note("skipped: a reference to another file", entity.line);
    if (depth >= max_depth)
      refuse_dxf(entity.line, "blocks are nested more than " + std::to_string(max_depth) + " deep: does " +
                                  dxf_quoted(at.block) + " contain itself?");
    const std::vector<Entity>& inside = entities_of(found->first, found->second);
    for (std::size_t row = 0; row < at.rows; ++row)
      for (std::size_t column = 0; column < at.columns; ++column) {
        // Empty blocks cost time, too: billions of them can be written in a few lines.
        if ((inserted_ += 1 + inside.size()) > 4 * reading_.max_curves)
          refuse_dxf(entity.line, "more than " + std::to_string(4 * reading_.max_curves) + " entities inserted");
        count();
        const Affine inner = map * at.map(found->second.base, row, column);
        for (const Entity& e : inside) {
          if (faults_.size() >= max_faults) return;
          count();
          draw(e, inner, inherited, depth + 1);
        }
      }
  }

  const std::vector<Entity>& entities_of(const std::string& name, const DxfBlockPlace& place) {
    const auto [found, is_new] = blocks_.try_emplace(name);
    if (!is_new) return found->second;
    const auto here = tags_.mark();
    tags_.seek(place.first);
    DxfRecord record;
    while (faults_.size() < max_faults && tags_.next(record) && record.type != "ENDBLK" && record.type != "ENDSEC" &&
           record.type != "EOF") {
      count();
      parse(record, false, found->second);
    }
    tags_.seek(here);
    return found->second;
  }

  void report() {
    constexpr std::size_t max_notes = 50;
    std::size_t left = max_notes;
    for (const auto& [what, o] : noted_) {
      if (left-- == 0) {
        drawing_.notes.push_back("… and " + std::to_string(noted_.size() - max_notes) + " more kinds of notes");
        break;
      }
      drawing_.notes.push_back(what + " (" + std::to_string(o.count) + (o.count == 1 ? ", line " : ", first in line ") +
                               std::to_string(o.line) + ")");
    }
    if (dropped_ > 0)
      drawing_.notes.push_back(
          "dropped: " + std::to_string(dropped_) +
          (dropped_ == 1 ? " curve without length (line " : " curves without length (first in line ") +
          std::to_string(dropped_line_) + ")");
  }

  DxfTags tags_;
  const DxfReading& reading_;
  DxfFile file_;
  DxfDrawing drawing_;
  std::vector<InputFault> faults_;
  std::map<std::string, Occurrence> noted_;
  DxfLayers layers_;
  std::unordered_map<std::string, std::vector<Entity>> blocks_;
  enum class Space { model, paper, sheet } space_ = Space::model;  // sheet: a block that is one
  bool left_out_ = false;  // a curve was not drawn because of its layer or because it is invisible
  std::size_t inserted_ = 0, curves_ = 0, dropped_ = 0, dropped_line_ = 0;
};

}  // namespace

DxfDrawing read_dxf_drawing(std::string_view text, const DxfReading& reading, Progress progress) {
  if (dxf_is_binary(text)) return Reader(dxf_ascii(text, progress), reading, progress).read();
  // Lines of old Macintoshes end with CR alone.
  if (text.find('\n') == std::string_view::npos && text.find('\r') != std::string_view::npos) {
    std::string lines(text);
    std::replace(lines.begin(), lines.end(), '\r', '\n');
    return Reader(lines, reading, progress).read();
  }
  return Reader(text, reading, progress).read();
}

}  // namespace bahnwerk
