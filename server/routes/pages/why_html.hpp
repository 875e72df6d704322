#pragma once
/// Parts of a job's page: how good the plan is, and why it takes as long as it does. All texts of jobs are escaped.
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "server/pages/texts.hpp"

namespace bahnwerk::server {

/// What a plan's stored views say of its time.
struct Reasons {
  nlohmann::ordered_json limits;    ///< answer of api::limits_answer(); null: unknown
  nlohmann::ordered_json blocks;    ///< answer of api::blocks_document() in the order of time lost; null: unknown
  std::optional<double> feed_time;  ///< s, of what has a feed, at that feed all along
  double cycle = 0;                 ///< distance of two rows
  bool timed = true;                ///< whether rows are a time apart, s
};

/// Returns the first line of a result: the duration, or what a kind has in its place; whether it is good, or which
/// checks failed; the three largest limits; what is lost against the feed.
std::string verdict_line(const nlohmann::ordered_json& result, const Reasons& reasons, const Texts& text);
/// Returns the limits that some of the time belongs to as a table with bars, the largest first, with the number of each
/// for the page's module.
std::string limits_table(const nlohmann::ordered_json& limits, const Texts& text);
/// Returns the entries of an answer of api::blocks_document() as a table, with the rows of each for the page's module.
std::string slowest_blocks(const nlohmann::ordered_json& blocks, double cycle, const Texts& text);
/// Returns the section between two rests that is farthest from its own bound as a sentence.
std::string worst_section(const nlohmann::ordered_json& details, const Texts& text);
/// Returns what the job would take with one limit changed, as bars of the time won or lost.
std::string what_if_bars(const nlohmann::ordered_json& result, const Texts& text);

}  // namespace bahnwerk::server
