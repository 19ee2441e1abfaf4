#include "core/hdf5/writer.h"

#include <hdf5.h>

#include <algorithm>
#include <cassert>
#include <functional>
#include <numeric>
#include <utility>

#include "core/error.h"
#include "core/text.h"

namespace chironomia {
namespace {

// One open thing of HDF5.
class Handle {
  public:
    using Close = herr_t (*)(hid_t);

    Handle(hid_t id, Close close) : id_(id), close_(close) {}
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() {
        if (id_ >= 0) close_(id_);
    }

    operator hid_t() const { return id_; }
    hid_t release() { return std::exchange(id_, -1); }
    explicit operator bool() const { return id_ >= 0; }

  private:
    hid_t id_;
    Close close_;
};

// Switches off the messages that HDF5 prints to stderr for each failed call; we throw our own.
class QuietErrors {
  public:
    QuietErrors() {
        H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }
    ~QuietErrors() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
    QuietErrors(const QuietErrors&) = delete;
    QuietErrors& operator=(const QuietErrors&) = delete;

  private:
    H5E_auto2_t print_ = nullptr;
    void* data_ = nullptr;
};

// A file in memory that is written to the disk when it is closed.
Handle memory_access() {
    Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fapl_core(access, size_t{1} << 20, true);
    // Since 1.8 there is a layout with a checksum at every header, so damage is seen before it is followed.
    H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
    return access;
}

// Without times the same contents give the same bytes.
Handle untimed(hid_t kind) {
    Handle list(H5Pcreate(kind), H5Pclose);
    H5Pset_obj_track_times(list, false);
    return list;
}

// The reader follows links that lie in the header of their group, and no others.
constexpr unsigned kMostLinks = 60;

Handle text_type(size_t size) {
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type, std::max<size_t>(size, 1));
    H5Tset_cset(type, H5T_CSET_UTF8);
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    return type;
}

// IEEE 754 binary16.
Handle half_type() {
    Handle type(H5Tcopy(H5T_IEEE_F32LE), H5Tclose);
    H5Tset_fields(type, 15, 10, 5, 0, 10);
    H5Tset_precision(type, 16);
    H5Tset_size(type, 2);
    H5Tset_ebias(type, 15);
    return type;
}

// Numbers or texts of one type.
struct Elements {
    hid_t stored;      // their type in the file
    hid_t given;       // their type at `data`
    const void* data;  // in C order
};

size_t count_of(const Hdf5Writer::Shape& shape) {
    return std::accumulate(shape.begin(), shape.end(), size_t{1}, std::multiplies<>());
}

}  // namespace

struct Hdf5Writer::State {
    State(const std::filesystem::path& path, std::string name)
        : where(std::move(name)),
          creation(untimed(H5P_FILE_CREATE)),
          access(memory_access()),
          file(create(path), H5Fclose) {}

    hid_t create(const std::filesystem::path& path) {
        H5Pset_link_phase_change(creation, kMostLinks, kMostLinks);
        const hid_t id = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access);
        check(id < 0 ? -1 : 0);
        return id;
    }

    void check(herr_t result) const {
        if (result < 0) throw Error(format("{}: cannot be written; check free space and permissions", where));
    }
    void check(const Handle& handle) const { check(handle ? 0 : -1); }

    void write(const std::string& path, const Shape& shape, const Elements& elements,
               Packing packing = Packing::plain) {
        const std::vector<hsize_t> extents(shape.begin(), shape.end());
        const Handle made = untimed(H5P_DATASET_CREATE);
        if (packing != Packing::plain && count_of(shape) > 0 && !extents.empty()) {
            H5Pset_chunk(made, static_cast<int>(extents.size()), extents.data());
            H5Pset_shuffle(made);
            H5Pset_deflate(made, 4);
        }
        const Handle space(extents.empty()
                               ? H5Screate(H5S_SCALAR)
                               : H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr),
                           H5Sclose);
        const Handle set(
            H5Dcreate2(file, path.c_str(), elements.stored, space, H5P_DEFAULT, made, H5P_DEFAULT), H5Dclose);
        check(set);
        check(H5Dwrite(set, elements.given, H5S_ALL, H5S_ALL, H5P_DEFAULT, elements.data));
    }

    void write_attribute(const std::string& path, const char* name, const Elements& value) {
        const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
        const Handle attribute(H5Acreate_by_name(file, path.c_str(), name, value.stored, space, H5P_DEFAULT,
                                                 H5P_DEFAULT, H5P_DEFAULT),
                               H5Aclose);
        check(attribute);
        check(H5Awrite(attribute, value.given, value.data));
    }

    std::string where;
    QuietErrors quiet;
    Handle creation, access;
    Handle file;
};

Hdf5Writer::Hdf5Writer(const std::filesystem::path& file, std::string where)
    : state_(std::make_unique<State>(file, std::move(where))) {}

Hdf5Writer::~Hdf5Writer() = default;

void Hdf5Writer::make_group(const std::string& path) {
    const Handle creation = untimed(H5P_GROUP_CREATE);
    H5Pset_link_phase_change(creation, kMostLinks, kMostLinks);
    state_->check(
        Handle(H5Gcreate2(state_->file, path.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose));
}

void Hdf5Writer::write_attribute(const char* name, std::string_view text, const std::string& path) {
    const Handle type = text_type(text.size());
    // A text of no letters has one byte.
    state_->write_attribute(path, name,
                            {.stored = type, .given = type, .data = text.empty() ? "" : text.data()});
}

void Hdf5Writer::write_attribute(const char* name, std::int32_t value, const std::string& path) {
    state_->write_attribute(path, name, {.stored = H5T_STD_I32LE, .given = H5T_NATIVE_INT32, .data = &value});
}

void Hdf5Writer::write_attribute(const char* name, double value, const std::string& path) {
    state_->write_attribute(path, name,
                            {.stored = H5T_IEEE_F64LE, .given = H5T_NATIVE_DOUBLE, .data = &value});
}

void Hdf5Writer::write_number(const std::string& path, double value) {
    state_->write(path, {}, {.stored = H5T_IEEE_F64LE, .given = H5T_NATIVE_DOUBLE, .data = &value});
}

void Hdf5Writer::write_count(const std::string& path, std::uint64_t value) {
    state_->write(path, {}, {.stored = H5T_STD_U64LE, .given = H5T_NATIVE_UINT64, .data = &value});
}

void Hdf5Writer::write_floats(const std::string& path, const Shape& shape, std::span<const float> values,
                              Packing packing) {
    assert(values.size() == count_of(shape));
    const Handle half = half_type();
    const hid_t stored = packing == Packing::float16 ? half : H5T_IEEE_F32LE;
    state_->write(path, shape, {.stored = stored, .given = H5T_NATIVE_FLOAT, .data = values.data()}, packing);
}

void Hdf5Writer::write_doubles(const std::string& path, const Shape& shape, std::span<const double> values) {
    assert(values.size() == count_of(shape));
    state_->write(path, shape, {.stored = H5T_IEEE_F64LE, .given = H5T_NATIVE_DOUBLE, .data = values.data()});
}

void Hdf5Writer::write_ints(const std::string& path, const Shape& shape, std::span<const int> values) {
    assert(values.size() == count_of(shape));
    state_->write(path, shape, {.stored = H5T_STD_I32LE, .given = H5T_NATIVE_INT, .data = values.data()});
}

void Hdf5Writer::write_bytes(const std::string& path, const Shape& shape,
                             std::span<const std::uint8_t> values) {
    assert(values.size() == count_of(shape));
    state_->write(path, shape, {.stored = H5T_STD_U8LE, .given = H5T_NATIVE_UINT8, .data = values.data()});
}

void Hdf5Writer::write_texts(const std::string& path, const std::vector<std::string>& texts) {
    if (texts.empty()) return;
    size_t longest = 1;
    for (const std::string& text : texts) longest = std::max(longest, text.size());
    std::string cells(texts.size() * longest, '\0');
    for (size_t i = 0; i < texts.size(); ++i)
        std::copy(texts[i].begin(), texts[i].end(), cells.begin() + static_cast<std::ptrdiff_t>(i * longest));
    const Handle type = text_type(longest);
    state_->write(path, {texts.size()}, {.stored = type, .given = type, .data = cells.data()});
}

void Hdf5Writer::close() {
    state_->check(H5Fclose(state_->file.release()));
}

}  // namespace chironomia
