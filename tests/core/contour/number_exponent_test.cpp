#include "core/contour/gcode/words/number_exponent.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/contour/gcode/words/words.hpp"
#include "tests/core/contour/gcode_support.hpp"

namespace bahnwerk::gcode {
namespace {

ExponentReading reading(std::string_view number, std::string_view rest, bool capital = true) {
  std::size_t size = 0;
  return exponent_reading(number, rest, capital, size);
}

TEST(NumberExponent, AnotherCaseThanTheWordsLetterIsAnExponent) {
  for (const char* rest : {"e-14", "e5", "e+03 Y2", "e-7"}) EXPECT_EQ(reading("1.5", rest), ExponentReading::exponent);
  EXPECT_EQ(reading("1.5", "E-14", false), ExponentReading::exponent);
}

TEST(NumberExponent, TheOutputOfFormattersIsAnExponent) {
  EXPECT_EQ(reading("1.42109", "E-14"), ExponentReading::exponent);   // C, Python, C#
  EXPECT_EQ(reading("0.142109", "E-13"), ExponentReading::exponent);  // Fortran
  EXPECT_EQ(reading("1", "E-05"), ExponentReading::exponent);
  EXPECT_EQ(reading("2.5", "E+07"), ExponentReading::exponent);
  EXPECT_EQ(reading("1.42109", "e-14", false), ExponentReading::exponent);
}

TEST(NumberExponent, WordsThatAPrinterMayMeanAreUnclear) {
  for (const char* rest : {"E5", "E-5", "E-10 F300"}) EXPECT_EQ(reading("10", rest), ExponentReading::unclear) << rest;
  EXPECT_EQ(reading("1.0", "E-5"), ExponentReading::unclear);
}

TEST(NumberExponent, AWordEHasAPointOrNoDigits) {
  for (const char* rest : {"E0.5", "E-1.25F300", "E", "E-", "EQ 2", "E[1]"})
    EXPECT_EQ(reading("10", rest), ExponentReading::word) << rest;
}

Line only(std::string_view text) {
  Lines lines(text);
  Line line;
  EXPECT_TRUE(lines.next(line, true));
  return line;
}

TEST(NumberExponent, NumbersOfALine) {
  EXPECT_EQ(only("G1 X1.42109e-14 Y5")['X'], 1.42109e-14);
  EXPECT_EQ(only("F1.2e3")['F'], 1200);
  EXPECT_EQ(only("x-2.5E-1")['X'], -0.25);
  EXPECT_EQ(only("Y2.5E-07 X0.25E+02")['X'], 25);
  EXPECT_EQ(only("X1 .5e-1")['X'], 0.15);  // blanks divide the digits
  EXPECT_EQ(only("X1e-999")['X'], 0);
  EXPECT_NE(only("X1e99").fault, "");
  EXPECT_FALSE(only("X1.5e-3").has('E'));
  // A second E cannot be a word.
  EXPECT_EQ(only("E2 X5E-2")['X'], 0.05);
  EXPECT_EQ(only("G1 E1.5E-5")['E'], 1.5e-5);
}

TEST(NumberExponent, WordsEStayWords) {
  const Line line = only("G1X10.5Y20E0.25F300");
  EXPECT_EQ(line.fault, "");
  EXPECT_EQ(line['Y'], 20);
  EXPECT_EQ(line['E'], 0.25);
  EXPECT_EQ(only("G1E-2")['E'], -2);  // G words have no exponent
  EXPECT_EQ(only("X10 E5")['E'], 5);
  EXPECT_EQ(only("X10 E5")['X'], 10);
}

TEST(NumberExponent, UnclearExponentsAreRefusedUnlessTheProgramIsForAPrinter) {
  EXPECT_EQ(bahnwerk::fault_lines("G1 F60 X5\nX10E5\nX2"), (std::vector{2}));
  const Contour c = bahnwerk::read_gcode("M83\nG1 F60 X5\nX10E5\nX12");
  EXPECT_EQ(c.path.length(), 12);
  const std::string fault = bahnwerk::gcode_faults("G1 X12.5E-3").front().message;
  EXPECT_NE(fault.find("line 1: "), std::string::npos);
  EXPECT_NE(fault.find("exponent"), std::string::npos);
}

TEST(NumberExponent, CoordinatesAndFeedsOfAProgram) {
  // A corner at (0, 8), then to (12, 8): nothing that rounding left of 0 may become a place.
  const Contour c = bahnwerk::read_gcode("G0 X0 Y0\nG1 X2.2204e-16 Y8 F1.5e3\nX12 Y8\n");
  EXPECT_NEAR(c.path.length(), 20, 1e-12);
  EXPECT_EQ(c.blocks.back().feed, 25);
  EXPECT_TRUE(c.notes.empty());
  EXPECT_NEAR(bahnwerk::read_gcode("#1=1.25e1\nG1 F60 X[#1 + 2.5E0] Y#1").path.length(), std::hypot(15, 12.5), 1e-12);
}

}  // namespace
}  // namespace bahnwerk::gcode
