#pragma once
/// Arrays of numbers as little-endian bytes, for the parts of views.
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace bahnwerk::api {

template <class T>
void put(std::string& out, const T& value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}

/// Takes numbers from the front of a part; throws std::runtime_error if it is too short.
class TakeBytes {
 public:
  explicit TakeBytes(std::string_view bytes) : rest_(bytes) {}
  template <class T>
  T one() {
    T value;
    std::memcpy(&value, take(sizeof value), sizeof value);
    return value;
  }
  template <class T>
  std::vector<T> array(std::size_t count) {
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), take(count * sizeof(T)), count * sizeof(T));
    return values;
  }

 private:
  const char* take(std::size_t size) {
    if (rest_.size() < size) throw std::runtime_error("a stored view is damaged");
    const char* const at = rest_.data();
    rest_.remove_prefix(size);
    return at;
  }
  std::string_view rest_;
};

}  // namespace bahnwerk::api
