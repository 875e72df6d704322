#include "core/contour/dxf/read/file.hpp"

#include <array>
#include <cmath>

namespace bahnwerk {
namespace {

/// The first tag with this code.
std::string_view value_of(const DxfRecord& record, int code) {
  for (const DxfTag& tag : record.tags)
    if (tag.code == code) return tag.value;
  return {};
}

void header(const DxfRecord& section, DxfFile& file) {
  bool units = false;
  for (const DxfTag& tag : section.tags) {
    if (tag.code == 9) units = tag.value == "$INSUNITS";
    if (!units || tag.code != 70) continue;
    file.unit = dxf_integer(tag);
    file.unit_line = tag.line;
  }
}

void layer(const DxfRecord& record, DxfFile& file) {
  DxfLayer layer;
  for (const DxfTag& tag : record.tags) {
    if (tag.code == 2) layer.name = tag.value;
    if (tag.code == 70) layer.frozen = (dxf_integer(tag) & 1) != 0;
    if (tag.code == 62) layer.off = dxf_integer(tag) < 0;
    if (tag.code == 290) layer.unplotted = dxf_integer(tag) == 0;
  }
  file.layers.emplace(dxf_lower(layer.name), layer);
}

void block(const DxfRecord& record, const DxfTags& tags, DxfFile& file) {
  DxfBlockPlace place;
  std::string_view name;
  place.line = record.line;
  place.first = tags.mark();
  for (const DxfTag& tag : record.tags) {
    if (tag.code == 2) name = tag.value;
    if (tag.code == 10) place.base.x = dxf_real(tag);
    if (tag.code == 20) place.base.y = dxf_real(tag);
    if (tag.code == 30) place.base.z = dxf_real(tag);
    if (tag.code == 70) place.external = (dxf_integer(tag) & 4) != 0;
  }
  file.blocks.emplace(dxf_lower(name), place);
}

}  // namespace

std::string dxf_lower(std::string_view name) {
  std::string lower(name);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

std::optional<double> dxf_unit(long code) {
  // Units in the order of their codes: none, inch, foot, mile; mm, cm, m, km; microinch, mil, yard; ångström, nm, µm;
  // dm, dam, hm; Gm, astronomical unit, light year, parsec; US survey foot, inch, yard, mile.
  constexpr double foot = 1200000.0 / 3937;
  constexpr std::array<double, 21> unit{0,    25.4, 304.8, 1609344, 1,   10,  1e3, 1e6, 2.54e-5, 0.0254, 914.4,
                                        1e-7, 1e-6, 1e-3,  100,     1e4, 1e5, 0,   0,   0,       0};
  constexpr std::array<double, 4> survey{foot, foot / 12, 3 * foot, 5280 * foot};
  const auto i = static_cast<std::size_t>(code);  // index; beyond all units for negative codes
  if (i >= unit.size() && i - unit.size() < survey.size()) return survey[i - unit.size()];
  if (i >= unit.size() || unit[i] == 0) return {};
  return unit[i];
}

DxfFile dxf_file(DxfTags& tags) {
  DxfFile file;
  DxfRecord record;
  std::string_view section;
  std::size_t section_line = 0;
  bool ended = false, layers = false;
  for (;;) {
    // Only these sections are needed; entities are read later.
    const bool keep = section != "ENTITIES" && section != "OBJECTS" && section != "CLASSES";
    if (!tags.next(record, keep)) break;
    if (record.type == "EOF") {
      ended = true;
      if (tags.behind_end().find_first_not_of(std::string_view(" \t\r\n\x1A\0", 6)) != std::string_view::npos)
        file.notes.push_back("what follows EOF in line " + std::to_string(record.line) + " is not read");
      break;
    }
    if (record.type == "SECTION") {
      // The tags of the first record of a section were stored: it began outside of any section.
      if (!section.empty()) refuse_dxf(record.line, "a SECTION begins inside section " + dxf_quoted(section));
      section = value_of(record, 2);
      section_line = record.line;
      if (section.empty()) refuse_dxf(record.line, "a SECTION without a name (group code 2)");
      if (section == "HEADER") header(record, file);
      if (section == "ENTITIES" && !file.entities) file.entities = tags.mark();
      // Nothing behind the entities is needed, and data of other programs there is not always valid.
      if (section == "OBJECTS" && file.entities) return file;
    } else if (record.type == "ENDSEC") {
      section = {};
    } else if (section == "TABLES") {
      if (record.type == "TABLE") layers = value_of(record, 2) == "LAYER";
      if (record.type == "LAYER" && layers) layer(record, file);
    } else if (section == "BLOCKS" && record.type == "BLOCK") {
      block(record, tags, file);
    }
  }
  if (!section.empty())
    refuse_dxf(tags.line(), "the file is cut off: section " + dxf_quoted(section) + ", begun in line " +
                                std::to_string(section_line) + ", does not end");
  if (!file.entities) refuse_dxf(std::max<std::size_t>(tags.line(), 1), "no DXF file: it has no section ENTITIES");
  if (!ended) file.notes.push_back("the file does not end with EOF; it may be cut off");
  return file;
}

}  // namespace bahnwerk
