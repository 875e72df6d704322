#pragma once
/// Compression of texts and setpoints, lossless to the last bit, NaN and −0 included.
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace bahnwerk::server {

std::string pack_text(std::string_view text);
std::string unpack_text(std::string_view packed);  ///< throws std::runtime_error when damaged

/// Packs rows × columns doubles, row-major. Setpoints are smooth, so the second difference of the bit patterns per
/// column is small: differences, zigzag, bytes of equal weight together, then zstd. Packing costs about 50 ns,
/// unpacking 20 ns per double.
std::string pack_rows(const double* values, std::size_t rows, std::size_t columns);
/// Unpacks rows. Throws std::runtime_error when damaged or not of `columns` columns.
void unpack_rows(std::string_view packed, std::size_t columns, std::vector<double>& out);

}  // namespace bahnwerk::server
