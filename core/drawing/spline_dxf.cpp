#include "core/drawing/spline_dxf.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <stdexcept>
#include <vector>

namespace bahnwerk {
namespace {

/// Writes pairs of lines: group code and value.
class Tags {
 public:
  Tags& tag(int code, const std::string& value) {
    const std::string number = std::to_string(code);
    text_ += std::string(number.size() < 3 ? 3 - number.size() : 0, ' ') + number + '\n' + value + '\n';
    return *this;
  }
  Tags& tag(int code, const char* value) { return tag(code, std::string(value)); }
  Tags& tag(int code, int value) { return tag(code, std::to_string(value)); }
  Tags& tag(int code, std::size_t value) { return tag(code, std::to_string(value)); }
  Tags& tag(int code, double value) {
    std::array<char, 32> text{};
    std::string written(text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
    if (written.find_first_of(".e") == std::string::npos) written += ".0";
    return tag(code, written);
  }
  Tags& handle(int value) { return hexadecimal(5, value); }
  Tags& owner(int value) { return hexadecimal(330, value); }
  Tags& hexadecimal(int code, int value) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "%X", static_cast<unsigned>(value));
    return tag(code, text.data());
  }
  Tags& section(const char* name) { return tag(0, "SECTION").tag(2, name); }
  Tags& end() { return tag(0, "ENDSEC"); }
  std::string text() && { return std::move(text_); }

 private:
  std::string text_;
};

// Handles of the tables and objects that every drawing has.
enum Handle { ltypes = 0x10, layers, styles, apps, records, model, paper, root, groups, next };

void tables(Tags& t, const std::string& layer, int& handle) {
  const auto table = [&](const char* name, Handle of, std::size_t count) {
    t.tag(0, "TABLE").tag(2, name).handle(of).owner(0).tag(100, "AcDbSymbolTable").tag(70, count);
  };
  const auto record = [&](const char* kind, Handle of, const char* marker, const std::string& name, int own) {
    t.tag(0, kind).handle(own > 0 ? own : handle++).owner(of).tag(100, "AcDbSymbolTableRecord").tag(100, marker);
    t.tag(2, name);
  };
  t.section("TABLES");
  table("LTYPE", ltypes, 3);
  for (const char* name : {"ByBlock", "ByLayer", "Continuous"}) {
    record("LTYPE", ltypes, "AcDbLinetypeTableRecord", name, 0);
    t.tag(70, 0).tag(3, "").tag(72, 65).tag(73, 0).tag(40, 0.0);
  }
  t.tag(0, "ENDTAB");
  table("LAYER", layers, 2);
  for (const std::string& name : {std::string("0"), layer}) {
    record("LAYER", layers, "AcDbLayerTableRecord", name, 0);
    t.tag(70, 0).tag(62, 7).tag(6, "Continuous");
  }
  t.tag(0, "ENDTAB");
  table("STYLE", styles, 1);
  record("STYLE", styles, "AcDbTextStyleTableRecord", "Standard", 0);
  t.tag(70, 0).tag(40, 0.0).tag(41, 1.0).tag(50, 0.0).tag(71, 0).tag(42, 2.5).tag(3, "txt").tag(4, "");
  t.tag(0, "ENDTAB");
  table("APPID", apps, 1);
  record("APPID", apps, "AcDbRegAppTableRecord", "ACAD", 0);
  t.tag(70, 0).tag(0, "ENDTAB");
  table("BLOCK_RECORD", records, 2);
  record("BLOCK_RECORD", records, "AcDbBlockTableRecord", "*Model_Space", model);
  record("BLOCK_RECORD", records, "AcDbBlockTableRecord", "*Paper_Space", paper);
  t.tag(0, "ENDTAB").end();
}

void blocks(Tags& t, int& handle) {
  t.section("BLOCKS");
  for (const Handle space : {model, paper}) {
    const char* const name = space == model ? "*Model_Space" : "*Paper_Space";
    const auto part = [&](const char* kind, const char* marker) {
      t.tag(0, kind).handle(handle++).owner(space).tag(100, "AcDbEntity").tag(8, "0").tag(100, marker);
    };
    part("BLOCK", "AcDbBlockBegin");
    t.tag(2, name).tag(70, 0).tag(10, 0.0).tag(20, 0.0).tag(30, 0.0).tag(3, name).tag(1, "");
    part("ENDBLK", "AcDbBlockEnd");
  }
  t.end();
}

void spline(Tags& t, const NurbsPath& path, const std::string& layer, int& handle) {
  constexpr std::size_t w = spline_dimension;
  const bool rational =
      std::any_of(path.points.begin(), path.points.end(), [](const HomogeneousPoint& p) { return p[w] != 1; });
  t.tag(0, "SPLINE").handle(handle++).owner(model).tag(100, "AcDbEntity").tag(8, layer).tag(100, "AcDbSpline");
  t.tag(70, rational ? 4 : 0).tag(71, path.degree).tag(72, path.knots.size()).tag(73, path.points.size()).tag(74, 0);
  t.tag(42, 1e-9).tag(43, 1e-9);
  for (const double knot : path.knots) t.tag(40, knot);
  if (rational)
    for (const HomogeneousPoint& p : path.points) t.tag(41, p[w]);
  for (const HomogeneousPoint& p : path.points) {
    const Vec at = place(projected(p));
    t.tag(10, at.x).tag(20, at.y).tag(30, at.z);
  }
}

}  // namespace

std::string splines_as_dxf(std::span<const NurbsPath> paths, const std::string& layer) {
  const char* const plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  if (layer.empty() || layer.find_first_not_of(plain) != std::string::npos)
    throw std::invalid_argument("a layer's name consists of letters, digits, _ and -");
  int handle = next;
  Tags body;
  tables(body, layer, handle);
  blocks(body, handle);
  body.section("ENTITIES");
  for (const NurbsPath& path : paths) spline(body, path, layer, handle);
  body.end().section("OBJECTS");
  body.tag(0, "DICTIONARY").handle(root).owner(0).tag(100, "AcDbDictionary").tag(281, 1).tag(3, "ACAD_GROUP");
  body.hexadecimal(350, groups);
  body.tag(0, "DICTIONARY").handle(groups).owner(root).tag(100, "AcDbDictionary").tag(281, 1).end().tag(0, "EOF");
  Tags head;
  head.section("HEADER").tag(9, "$ACADVER").tag(1, "AC1015").tag(9, "$INSUNITS").tag(70, 4);
  head.tag(9, "$MEASUREMENT").tag(70, 1).tag(9, "$HANDSEED").handle(handle).end();
  return std::move(head).text() + std::move(body).text();
}

}  // namespace bahnwerk
