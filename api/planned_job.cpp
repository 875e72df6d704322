#include "api/planned_job.hpp"

#include "core/base/progress.hpp"

namespace bahnwerk::api {
namespace {

class Output final : public nlohmann::detail::output_adapter_protocol<char> {
 public:
  Output(std::string& text, Progress progress) : text_(text), progress_(progress) {}
  void write_character(char c) override {
    text_.push_back(c);
    ask();
  }
  void write_characters(const char* text, std::size_t length) override {
    text_.append(text, length);
    ask();
  }

 private:
  static constexpr std::size_t interval = 256 << 10;
  void ask() {
    if (text_.size() < next_) return;
    next_ = text_.size() + interval;
    progress_.report("storing", 1);
  }
  std::string& text_;
  Progress progress_;
  std::size_t next_ = 0;
};

}  // namespace

std::string result_text(const PlannedJob& planned, Progress progress) {
  std::string text;
  const auto output = std::make_shared<Output>(text, progress);
  nlohmann::detail::serializer<nlohmann::ordered_json>(output, ' ').dump(planned.result, false, false, 0);
  return text;
}

}  // namespace bahnwerk::api
