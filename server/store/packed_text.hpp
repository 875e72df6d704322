#pragma once
/// Packed texts (codec.hpp), read in pieces from wherever a store has them.
#include <functional>
#include <memory>
#include <string>

#include "server/store/store.hpp"

namespace bahnwerk::server {

/// Returns `bytes` bytes from `offset` on of a packed text. Throws StoreError when the text is gone.
using PackedPart = std::function<std::string(std::size_t offset, std::size_t bytes)>;

/// Opens a packed text of `bytes` bytes. Of a text of many frames it keeps their index alone between two pieces: 4
/// bytes per frame. Throws StoreError when damaged.
std::unique_ptr<StoredText> open_packed_text(std::size_t bytes, PackedPart part);

/// Returns a text that is in memory.
std::unique_ptr<StoredText> whole_text(std::string text);

}  // namespace bahnwerk::server
