#include "stock/mesh/io/zip_archive.hpp"

#include <zlib.h>

#include <cstdint>

namespace frustum::stock {
namespace {

void put16(std::string& out, unsigned value) {
  out.push_back(static_cast<char>(value & 0xFFU));
  out.push_back(static_cast<char>(value >> 8U & 0xFFU));
}
void put32(std::string& out, std::size_t value) {
  put16(out, static_cast<unsigned>(value & 0xFFFFU));
  put16(out, static_cast<unsigned>(value >> 16U & 0xFFFFU));
}

// The bare deflate stream that ZIP wants, without zlib's own header.
std::string deflated(std::string_view bytes) {
  z_stream stream{};
  constexpr int kBareWindow = -15;
  // Level 3: coordinates hardly shrink further with more effort.
  if (deflateInit2(&stream, 3, Z_DEFLATED, kBareWindow, 8, Z_DEFAULT_STRATEGY) != Z_OK) return {};
  std::string out(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  // zlib only reads from next_in.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

// What the local and the central header have in common, from the version needed on.
std::string facts_of(const ZipEntry& entry, std::size_t packed) {
  std::string out;
  put16(out, 20);  // version 2.0: deflate
  put16(out, 0);
  put16(out, 8);     // deflate
  put16(out, 0);     // 00:00
  put16(out, 0x21);  // 1980-01-01
  put32(out, crc32_z(0, reinterpret_cast<const Bytef*>(entry.bytes.data()), entry.bytes.size()));
  put32(out, packed);
  put32(out, entry.bytes.size());
  put16(out, static_cast<unsigned>(entry.name.size()));
  put16(out, 0);
  return out;
}

}  // namespace

std::string zip_archive(std::span<const ZipEntry> entries) {
  std::string out;
  std::string directory;
  for (const ZipEntry& entry : entries) {
    const std::size_t start = out.size();
    const std::string packed = deflated(entry.bytes);
    const std::string facts = facts_of(entry, packed.size());
    put32(out, 0x04034B50);
    out.append(facts).append(entry.name).append(packed);
    put32(directory, 0x02014B50);
    put16(directory, 20);
    directory.append(facts);
    put16(directory, 0);  // no comment
    put16(directory, 0);  // first disk
    put16(directory, 0);
    put32(directory, 0);
    put32(directory, start);
    directory.append(entry.name);
  }
  const std::size_t at = out.size();
  out.append(directory);
  put32(out, 0x06054B50);
  put32(out, 0);
  put16(out, static_cast<unsigned>(entries.size()));
  put16(out, static_cast<unsigned>(entries.size()));
  put32(out, directory.size());
  put32(out, at);
  put16(out, 0);
  return out;
}

}  // namespace frustum::stock
