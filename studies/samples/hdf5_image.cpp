#include "studies/samples/hdf5_image.hpp"

#include <fmt/format.h>
#include <hdf5.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <utility>

#include "studies/samples/packed_chunk.hpp"

namespace frustum::studies {
namespace {

// Bytes of a chunk: a column of a part has four, which are packed at once.
constexpr std::size_t kChunkBytes = 1U << 17U;
// What the library is told of the filter: packed_chunk.hpp packs.
constexpr int kDeflateLevel = 1;
// Bytes by which the image of a file grows.
constexpr std::size_t kImageBytes = 1U << 20U;
// An image has a name, and the library looks for it on the disk: where nothing can be.
constexpr const char* kNowhere = "/dev/null/samples";

// A handle of the library and how it is given back.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  [[nodiscard]] hid_t id() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

struct NumberType {
  hid_t in_memory, in_file;
  std::size_t size;
};
NumberType type_of(NumberKind kind) {
  switch (kind) {
    case NumberKind::real:
      return {H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, sizeof(double)};
    case NumberKind::whole:
      return {H5T_NATIVE_INT64, H5T_STD_I64LE, sizeof(std::int64_t)};
    case NumberKind::flag:
      break;
  }
  return {H5T_NATIVE_UINT8, H5T_STD_U8LE, 1};
}

// In memory alone: nothing of it reaches a disk before its bytes are asked for.
Handle in_memory() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access.id(), kImageBytes, 0);
  return access;
}

// What the library would print of its own of each refusal.
void be_silent() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

Handle text_type(std::size_t length) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), std::max<std::size_t>(1, length));
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  return type;
}

bool write_attribute(hid_t object, const std::string& name, hid_t in_file, hid_t in_memory,
                     const void* value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(
      H5Acreate2(object, name.c_str(), in_file, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute && H5Awrite(attribute.id(), in_memory, value) >= 0;
}

bool write_text(hid_t object, const std::string& name, const std::string& text) {
  const Handle type = text_type(text.size());
  const std::string value = text.empty() ? std::string(1, '\0') : text;
  return write_attribute(object, name, type.id(), type.id(), value.data());
}

std::optional<std::string> read_text(hid_t object, const std::string& name) {
  if (H5Aexists(object, name.c_str()) <= 0) return std::nullopt;
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute.id()), H5Tclose);
  if (H5Tget_class(type.id()) != H5T_STRING || H5Tis_variable_str(type.id()) != 0) {
    return std::nullopt;
  }
  std::string text(H5Tget_size(type.id()), '\0');
  if (H5Aread(attribute.id(), type.id(), text.data()) < 0) return std::nullopt;
  text.erase(std::find(text.begin(), text.end(), '\0'), text.end());
  return text;
}

// Rows of a chunk, of a table that has so many.
std::size_t chunk_rows(std::size_t rows, std::size_t columns, std::size_t size) {
  return std::clamp<std::size_t>(kChunkBytes / (columns * size), 1, rows);
}

// How often `body(i)` for i from 0 on returned false.
template <class Body>
bool all_of_them(std::size_t count, const Body& body) {
  std::vector<std::uint8_t> done(count);
  tbb::parallel_for(std::size_t{0}, count,
                    [&](std::size_t i) { done[i] = body(i) ? std::uint8_t{1} : std::uint8_t{0}; });
  return std::ranges::all_of(done, [](std::uint8_t d) { return d == 1; });
}

}  // namespace

struct Hdf5Writer::Image {
  Handle file{}, make_links{};
  std::string refused{};  // the first name that was

  bool refuse(const std::string& name) {
    if (refused.empty()) refused = name;
    return false;
  }

  // Groups do not note when they were made, and list what they hold in the order of writing.
  [[nodiscard]] static Handle group_properties() {
    Handle made(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
    H5Pset_obj_track_times(made.id(), false);
    H5Pset_link_creation_order(made.id(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    return made;
  }

  [[nodiscard]] bool make_groups(const std::string& name) const {
    const Handle properties = group_properties();
    for (auto slash = name.find('/', 1); slash != std::string::npos;
         slash = name.find('/', slash + 1)) {
      const std::string group = name.substr(0, slash);
      if (H5Lexists(file.id(), group.c_str(), H5P_DEFAULT) > 0) continue;
      const Handle made(
          H5Gcreate2(file.id(), group.c_str(), make_links.id(), properties.id(), H5P_DEFAULT),
          H5Gclose);
      if (!made) return false;
    }
    return true;
  }
};

Hdf5Writer::Hdf5Writer() : image_(std::make_unique<Image>()) {
  be_silent();
  const Handle made(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(made.id(), false);
  H5Pset_link_creation_order(made.id(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  image_->file = Handle(H5Fcreate(kNowhere, H5F_ACC_TRUNC, made.id(), in_memory().id()), H5Fclose);
  image_->make_links = Handle(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_char_encoding(image_->make_links.id(), H5T_CSET_UTF8);
}
Hdf5Writer::~Hdf5Writer() = default;

bool Hdf5Writer::write_numbers(const std::string& name, const void* data, NumberKind kind,
                               std::size_t rows, std::size_t columns, const std::string& unit) {
  if (rows == 0) return true;
  const NumberType type = type_of(kind);
  const std::size_t wide = std::max<std::size_t>(1, columns);
  const std::size_t high = chunk_rows(rows, wide, type.size);
  const int dimensions = columns > 0 ? 2 : 1;
  const std::array<hsize_t, 2> extent{rows, wide}, chunk{high, wide};
  const Handle space(H5Screate_simple(dimensions, extent.data(), nullptr), H5Sclose);
  const Handle made(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(made.id(), false);
  H5Pset_chunk(made.id(), dimensions, chunk.data());
  H5Pset_shuffle(made.id());
  H5Pset_deflate(made.id(), kDeflateLevel);
  if (!image_->make_groups(name)) return image_->refuse(name);
  const Handle dataset(H5Dcreate2(image_->file.id(), name.c_str(), type.in_file, space.id(),
                                  image_->make_links.id(), made.id(), H5P_DEFAULT),
                       H5Dclose);
  if (!dataset) return image_->refuse(name);

  const std::size_t chunks = (rows + high - 1) / high, row_bytes = wide * type.size;
  std::vector<std::vector<unsigned char>> small(chunks);
  const bool all_packed = all_of_them(chunks, [&](std::size_t c) {
    const std::size_t first = c * high, count = std::min(high, rows - first);
    std::vector<unsigned char> whole(high * row_bytes);  // the last one is filled up with zeros
    std::memcpy(whole.data(), static_cast<const unsigned char*>(data) + first * row_bytes,
                count * row_bytes);
    small[c] = packed_chunk(whole, type.size, kind == NumberKind::real);
    return !small[c].empty();
  });
  if (!all_packed) return image_->refuse(name);
  for (std::size_t c = 0; c < chunks; ++c) {
    const std::array<hsize_t, 2> offset{c * high, 0};
    if (H5Dwrite_chunk(dataset.id(), H5P_DEFAULT, 0, offset.data(), small[c].size(),
                       small[c].data()) < 0) {
      return image_->refuse(name);
    }
  }
  if (!unit.empty() && !write_text(dataset.id(), "unit", unit)) return image_->refuse(name);
  return true;
}

bool Hdf5Writer::write(const std::string& name, std::span<const double> values,
                       const std::string& unit, std::size_t columns) {
  const std::size_t rows = columns > 0 ? values.size() / columns : values.size();
  return write_numbers(name, values.data(), NumberKind::real, rows, columns, unit);
}
bool Hdf5Writer::write(const std::string& name, std::span<const std::int64_t> values) {
  return write_numbers(name, values.data(), NumberKind::whole, values.size(), 0, {});
}
bool Hdf5Writer::write(const std::string& name, std::span<const std::uint8_t> values) {
  return write_numbers(name, values.data(), NumberKind::flag, values.size(), 0, {});
}

bool Hdf5Writer::write(const std::string& name, const std::vector<std::string>& texts) {
  if (texts.empty()) return true;
  std::size_t longest = 1;
  for (const std::string& text : texts) longest = std::max(longest, text.size());
  std::string all(texts.size() * longest, '\0');
  for (std::size_t i = 0; i < texts.size(); ++i) texts[i].copy(&all[i * longest], texts[i].size());
  const hsize_t extent = texts.size();
  const Handle space(H5Screate_simple(1, &extent, nullptr), H5Sclose);
  const Handle type = text_type(longest);
  const Handle made(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(made.id(), false);
  if (!image_->make_groups(name)) return image_->refuse(name);
  const Handle dataset(H5Dcreate2(image_->file.id(), name.c_str(), type.id(), space.id(),
                                  image_->make_links.id(), made.id(), H5P_DEFAULT),
                       H5Dclose);
  const bool written =
      dataset && H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()) >= 0;
  return written || image_->refuse(name);
}

bool Hdf5Writer::attribute(const std::string& name, const std::string& text) {
  return write_text(image_->file.id(), name, text) || image_->refuse(name);
}
bool Hdf5Writer::attribute(const std::string& name, std::uint64_t number) {
  return write_attribute(image_->file.id(), name, H5T_STD_U64LE, H5T_NATIVE_UINT64, &number) ||
         image_->refuse(name);
}

Result<std::string> Hdf5Writer::bytes() {
  const auto refusal = [](const std::string& name) {
    return error("hdf5"_id, fmt::format("HDF5 cannot hold a dataset '{}'", name),
                 "another name of the characteristic helps where it ends or begins with '/', or is "
                 "the beginning of another");
  };
  if (!image_->refused.empty()) return refusal(image_->refused);
  if (!image_->file || H5Fflush(image_->file.id(), H5F_SCOPE_GLOBAL) < 0) return refusal("");
  const ssize_t size = H5Fget_file_image(image_->file.id(), nullptr, 0);
  std::string bytes(size > 0 ? static_cast<std::size_t>(size) : 0, '\0');
  if (size <= 0 || H5Fget_file_image(image_->file.id(), bytes.data(), bytes.size()) != size) {
    return refusal("");
  }
  return bytes;
}

struct Hdf5Reader::Image {
  Handle file{};
  std::vector<std::string> datasets{};

  // Down the groups, in the order of writing where they know it.
  void list(hid_t group, const std::string& above) {
    H5G_info_t info{};
    if (H5Gget_info(group, &info) < 0) return;
    const Handle made(H5Gget_create_plist(group), H5Pclose);
    unsigned order = 0;
    H5Pget_link_creation_order(made.id(), &order);
    const auto by = (order & H5P_CRT_ORDER_INDEXED) != 0 ? H5_INDEX_CRT_ORDER : H5_INDEX_NAME;
    for (hsize_t i = 0; i < info.nlinks; ++i) {
      const ssize_t length =
          H5Lget_name_by_idx(group, ".", by, H5_ITER_INC, i, nullptr, 0, H5P_DEFAULT);
      if (length <= 0) continue;
      std::string name(static_cast<std::size_t>(length) + 1, '\0');
      H5Lget_name_by_idx(group, ".", by, H5_ITER_INC, i, name.data(), name.size(), H5P_DEFAULT);
      name.pop_back();
      const Handle object(H5Oopen(group, name.c_str(), H5P_DEFAULT), H5Oclose);
      const std::string full = above.empty() ? name : above + "/" + name;
      const H5I_type_t kind = object ? H5Iget_type(object.id()) : H5I_BADID;
      constexpr std::size_t kDeepest = 1000;  // of names: a file may link to itself
      if (kind == H5I_GROUP && full.size() < kDeepest) list(object.id(), full);
      if (kind == H5I_DATASET) datasets.push_back(full);
    }
  }

  [[nodiscard]] Handle dataset(const std::string& name) const {
    return {H5Dopen2(file.id(), name.c_str(), H5P_DEFAULT), H5Dclose};
  }

  [[nodiscard]] static std::vector<hsize_t> extent_of(hid_t dataset) {
    const Handle space(H5Dget_space(dataset), H5Sclose);
    const int dimensions = H5Sget_simple_extent_ndims(space.id());
    std::vector<hsize_t> extent(dimensions > 0 ? static_cast<std::size_t>(dimensions) : 0);
    if (!extent.empty()) H5Sget_simple_extent_dims(space.id(), extent.data(), nullptr);
    return extent;
  }
};

Hdf5Reader::Hdf5Reader(std::unique_ptr<Image> image) : image_(std::move(image)) {}
Hdf5Reader::Hdf5Reader(Hdf5Reader&&) noexcept = default;
Hdf5Reader& Hdf5Reader::operator=(Hdf5Reader&&) noexcept = default;
Hdf5Reader::~Hdf5Reader() = default;

std::optional<Hdf5Reader> Hdf5Reader::open(std::string_view bytes) {
  be_silent();
  constexpr std::string_view kSignature = "\x89HDF\r\n\x1a\n";
  if (!bytes.starts_with(kSignature)) return std::nullopt;
  const Handle access = in_memory();
  // The library copies the image; it does not write to it.
  if (H5Pset_file_image(access.id(), const_cast<char*>(bytes.data()), bytes.size()) < 0) {
    return std::nullopt;
  }
  auto image = std::make_unique<Image>();
  image->file = Handle(H5Fopen(kNowhere, H5F_ACC_RDONLY, access.id()), H5Fclose);
  if (!image->file) return std::nullopt;
  const Handle root(H5Gopen2(image->file.id(), "/", H5P_DEFAULT), H5Gclose);
  image->list(root.id(), "");
  return Hdf5Reader(std::move(image));
}

std::vector<std::string> Hdf5Reader::datasets() const { return image_->datasets; }

namespace {

// Chunks as Hdf5Writer writes them: whole rows, shuffled, then deflated. Nothing where they are
// not; then the library reads the dataset.
std::optional<std::vector<unsigned char>> unpacked(hid_t dataset, const NumberType& type,
                                                   std::size_t rows, std::size_t wide) {
  const Handle made(H5Dget_create_plist(dataset), H5Pclose);
  const Handle stored(H5Dget_type(dataset), H5Tclose);
  std::array<hsize_t, 2> chunk{0, 1};
  const bool plain = H5Pget_layout(made.id()) == H5D_CHUNKED && H5Pget_nfilters(made.id()) == 2 &&
                     H5Tequal(stored.id(), type.in_file) > 0 &&
                     H5Pget_chunk(made.id(), 2, chunk.data()) > 0 && chunk[1] == wide;
  if (!plain) return std::nullopt;
  for (const unsigned i : {0U, 1U}) {
    unsigned flags = 0, parameters = 0, configuration = 0;
    std::size_t count = 0;
    const H5Z_filter_t wanted = i == 0 ? H5Z_FILTER_SHUFFLE : H5Z_FILTER_DEFLATE;
    if (H5Pget_filter2(made.id(), i, &flags, &count, &parameters, 0, nullptr, &configuration) !=
        wanted) {
      return std::nullopt;
    }
  }
  const std::size_t high = chunk[0], chunks = (rows + high - 1) / high;
  const std::size_t row_bytes = wide * type.size;
  std::vector<std::vector<unsigned char>> small(chunks);
  for (std::size_t c = 0; c < chunks; ++c) {
    const std::array<hsize_t, 2> offset{c * high, 0};
    hsize_t size = 0;
    std::uint32_t skipped = 0;
    if (H5Dget_chunk_storage_size(dataset, offset.data(), &size) < 0) return std::nullopt;
    small[c].resize(size);
    if (size == 0 ||
        H5Dread_chunk(dataset, H5P_DEFAULT, offset.data(), &skipped, small[c].data()) < 0 ||
        skipped != 0) {
      return std::nullopt;
    }
  }
  std::vector<unsigned char> data(rows * row_bytes);
  const bool read = all_of_them(chunks, [&](std::size_t c) {
    const std::size_t first = c * high, count = std::min(high, rows - first);
    return unpack_chunk(small[c], type.size, high * row_bytes,
                        std::span(data).subspan(first * row_bytes, count * row_bytes));
  });
  if (!read) return std::nullopt;
  return data;
}

}  // namespace

template <class T>
std::optional<std::vector<T>> Hdf5Reader::numbers(const std::string& name, NumberKind kind) const {
  const Handle dataset = image_->dataset(name);
  if (!dataset) return std::nullopt;
  const auto extent = Image::extent_of(dataset.id());
  if (extent.empty() || extent.size() > 2) return std::nullopt;
  const Handle stored(H5Dget_type(dataset.id()), H5Tclose);
  const bool is_real = H5Tget_class(stored.id()) == H5T_FLOAT;
  if (is_real != (kind == NumberKind::real)) return std::nullopt;
  const std::size_t rows = extent[0], wide = extent.size() == 2 ? extent[1] : 1;
  constexpr std::size_t kMost = std::size_t{1} << 32U;  // numbers of a dataset: 32 GiB
  if (wide == 0 || rows > kMost / wide) return std::nullopt;
  const NumberType type = type_of(kind);
  std::vector<T> values(rows * wide);
  if (const auto data = unpacked(dataset.id(), type, rows, wide)) {
    std::memcpy(values.data(), data->data(), data->size());
    return values;
  }
  if (H5Dread(dataset.id(), type.in_memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    return std::nullopt;
  }
  return values;
}

std::optional<std::vector<double>> Hdf5Reader::reals(const std::string& name) const {
  return numbers<double>(name, NumberKind::real);
}
std::optional<std::vector<std::int64_t>> Hdf5Reader::whole_numbers(const std::string& name) const {
  return numbers<std::int64_t>(name, NumberKind::whole);
}
std::optional<std::vector<std::uint8_t>> Hdf5Reader::flags(const std::string& name) const {
  return numbers<std::uint8_t>(name, NumberKind::flag);
}

std::optional<std::vector<std::string>> Hdf5Reader::texts(const std::string& name) const {
  const Handle dataset = image_->dataset(name);
  if (!dataset) return std::nullopt;
  const auto extent = Image::extent_of(dataset.id());
  const Handle type(H5Dget_type(dataset.id()), H5Tclose);
  const bool fixed = H5Tget_class(type.id()) == H5T_STRING && H5Tis_variable_str(type.id()) == 0;
  if (!fixed || extent.size() != 1) return std::nullopt;
  const std::size_t length = H5Tget_size(type.id());
  std::string all(extent[0] * length, '\0');
  if (H5Dread(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()) < 0) {
    return std::nullopt;
  }
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < extent[0]; ++i) {
    std::string text = all.substr(i * length, length);
    text.erase(std::find(text.begin(), text.end(), '\0'), text.end());
    texts.push_back(std::move(text));
  }
  return texts;
}

std::string Hdf5Reader::unit(const std::string& name) const {
  const Handle dataset = image_->dataset(name);
  return dataset ? read_text(dataset.id(), "unit").value_or("") : "";
}

std::size_t Hdf5Reader::columns(const std::string& name) const {
  const Handle dataset = image_->dataset(name);
  const auto extent = dataset ? Image::extent_of(dataset.id()) : std::vector<hsize_t>{};
  return extent.size() == 2 ? extent[1] : 0;
}

std::optional<std::string> Hdf5Reader::text_attribute(const std::string& name) const {
  return read_text(image_->file.id(), name);
}

std::optional<std::uint64_t> Hdf5Reader::number_attribute(const std::string& name) const {
  if (H5Aexists(image_->file.id(), name.c_str()) <= 0) return std::nullopt;
  const Handle attribute(H5Aopen(image_->file.id(), name.c_str(), H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute.id()), H5Tclose);
  std::uint64_t number = 0;
  if (H5Tget_class(type.id()) != H5T_INTEGER ||
      H5Aread(attribute.id(), H5T_NATIVE_UINT64, &number) < 0) {
    return std::nullopt;
  }
  return number;
}

}  // namespace frustum::studies
