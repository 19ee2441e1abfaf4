// Writing HDF5 files that core/hdf5/file.h reads, and h5py.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace chironomia {

// The same calls give the same bytes: nothing of the time or the machine goes into the file. Each function
// throws Error if the file cannot be written. Paths have no slash at either end ("pose/data"); the group of
// an array must have been made, and holds at most 60 things.
class Hdf5Writer {
  public:
    enum class Packing {
        plain,
        deflated,  // shuffled and packed in one chunk
        float16,  // as deflated, of 16-bit floats: 11 bits of each number are kept, and none may be above 65504
    };

    //   file   where to write, such as the path of a PendingOutput
    //   where  what messages call it
    Hdf5Writer(const std::filesystem::path& file, std::string where);
    ~Hdf5Writer();
    Hdf5Writer(const Hdf5Writer&) = delete;
    Hdf5Writer& operator=(const Hdf5Writer&) = delete;

    void make_group(const std::string& path);
    // Of the file as a whole, or of the group at `path`; at most 8 for each.
    void write_attribute(const char* name, std::string_view text, const std::string& path = "/");
    void write_attribute(const char* name, std::int32_t value, const std::string& path = "/");
    void write_attribute(const char* name, double value, const std::string& path = "/");

    void write_number(const std::string& path, double value);        // float64, a scalar
    void write_count(const std::string& path, std::uint64_t value);  // uint64, a scalar
    // As many elements as the product of `shape`, in C order.
    using Shape = std::vector<std::size_t>;
    void write_floats(const std::string& path, const Shape& shape, std::span<const float> values,
                      Packing packing = Packing::plain);
    void write_doubles(const std::string& path, const Shape& shape, std::span<const double> values);
    void write_ints(const std::string& path, const Shape& shape, std::span<const int> values);
    void write_bytes(const std::string& path, const Shape& shape, std::span<const std::uint8_t> values);
    // UTF-8 of a fixed length. An empty list writes nothing.
    void write_texts(const std::string& path, const std::vector<std::string>& texts);

    // Everything goes to the disk here, and may not fit.
    void close();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace chironomia
