#include "core/recording/recording_mat.hpp"

#include <fmt/format.h>
#include <hdf5.h>
#include <matio.h>

#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <memory>
#include <optional>

namespace drift {
namespace {

using Variable = std::unique_ptr<matvar_t, void (*)(matvar_t*)>;
using MatFile = std::unique_ptr<mat_t, int (*)(mat_t*)>;

template <class T>
void append_as_double(const matvar_t& v, std::size_t n, std::vector<double>& out) {
  const T* data = static_cast<const T*>(v.data);
  for (std::size_t i = 0; i < n; ++i) out.push_back(static_cast<double>(data[i]));
}

/// The numbers of a variable of any numeric class.
std::optional<std::vector<double>> numbers(const matvar_t& v, std::size_t n) {
  std::vector<double> out;
  if (n == 0) return out;
  if (v.data == nullptr || v.data_size <= 0 || v.nbytes / static_cast<std::size_t>(v.data_size) < n)
    return std::nullopt;
  out.reserve(n);
  switch (v.data_type) {
    case MAT_T_DOUBLE:
      append_as_double<double>(v, n, out);
      break;
    case MAT_T_SINGLE:
      append_as_double<float>(v, n, out);
      break;
    case MAT_T_INT8:
      append_as_double<std::int8_t>(v, n, out);
      break;
    case MAT_T_UINT8:
      append_as_double<std::uint8_t>(v, n, out);
      break;
    case MAT_T_INT16:
      append_as_double<std::int16_t>(v, n, out);
      break;
    case MAT_T_UINT16:
      append_as_double<std::uint16_t>(v, n, out);
      break;
    case MAT_T_INT32:
      append_as_double<std::int32_t>(v, n, out);
      break;
    case MAT_T_UINT32:
      append_as_double<std::uint32_t>(v, n, out);
      break;
    case MAT_T_INT64:
      append_as_double<std::int64_t>(v, n, out);
      break;
    case MAT_T_UINT64:
      append_as_double<std::uint64_t>(v, n, out);
      break;
    default:
      return std::nullopt;
  }
  return out;
}

/// The text of a char variable (one row), UTF-16 turned into UTF-8. Empty if it is none.
std::optional<std::string> text_of(const matvar_t* v) {
  if (v == nullptr || v->class_type != MAT_C_CHAR || v->rank != 2) return std::nullopt;
  const std::size_t n = v->dims[0] * v->dims[1];
  if (n == 0) return std::string();
  const auto size = static_cast<std::size_t>(v->data_size);
  if (v->dims[0] != 1 || v->data == nullptr || size == 0 || v->nbytes < size || n > (1u << 20))
    return std::nullopt;
  // A UTF-8 text has more bytes than the characters its shape tells.
  const std::size_t held = v->nbytes / size;
  if (size == 1) return std::string(static_cast<const char*>(v->data), held);
  if (size != 2) return std::nullopt;
  std::string out;
  const auto* units = static_cast<const std::uint16_t*>(v->data);
  for (std::size_t i = 0; i < held; ++i) {
    const unsigned c = units[i];
    if (c < 0x80) {
      out += static_cast<char>(c);
    } else if (c < 0x800) {
      out += static_cast<char>(0xC0 | c >> 6);
      out += static_cast<char>(0x80 | (c & 0x3F));
    } else if (c >= 0xD800 && c < 0xE000) {
      out += '?';  // beyond the 65536 characters MATLAB handles as one
    } else {
      out += static_cast<char>(0xE0 | c >> 12);
      out += static_cast<char>(0x80 | (c >> 6 & 0x3F));
      out += static_cast<char>(0x80 | (c & 0x3F));
    }
  }
  return out;
}

class MatReader {
 public:
  explicit MatReader(RawSink& sink) : sink_(sink) {}

  void read(mat_t* file, matvar_t* v) {
    const std::string name = v->name == nullptr ? "" : v->name;
    const auto bad = [&](std::string_view wrong, std::string_view expected, std::string_view fix) {
      sink_.problems().add(in_quotes(name), wrong, expected, fix);
    };
    const bool is_text = name == "facts" || name == "units" || name.ends_with("_unit");
    const bool number = v->class_type >= MAT_C_DOUBLE && v->class_type <= MAT_C_UINT64;
    constexpr std::string_view column = "a real, full numeric column, one value per row";
    if (!is_text) {
      if (!number)
        return bad("it is a " + class_name(v->class_type), column, "Save only the channels");
      if (v->isComplex) return bad("it is complex", column, "Save its real part");
      if (v->rank != 2 || v->dims == nullptr)
        return bad(fmt::format("it has {} dimensions", v->rank), column,
                   "Save one variable per channel");
      if (v->dims[0] > 1 && v->dims[1] > 1)
        return bad(fmt::format("it is a {} x {} matrix", v->dims[0], v->dims[1]), column,
                   "Save one variable per channel");
    }
    if (Mat_VarReadDataAll(file, v) != 0)
      return bad("its values cannot be read", "an undamaged file", copy_again);
    if (name == "facts") {
      read_facts(v);
    } else if (name == "units" && v->class_type == MAT_C_STRUCT) {
      read_fields(
          v, [&](const char* field, const std::string& text) { sink_.unit(field, trimmed(text)); });
    } else if (name.ends_with("_unit") && text_of(v)) {
      sink_.unit(name.substr(0, name.size() - 5), trimmed(*text_of(v)));
    } else if (is_text) {
      bad("it is a " + class_name(v->class_type),
          name == "units" ? "a struct whose fields are units" : "a unit in quotes",
          "Write units.time = \"s\", units.acc_x = \"g\" and so on");
    } else {
      const std::size_t n = v->dims[0] * v->dims[1];
      if (const auto values = numbers(*v, n))
        sink_.column(name, *values);
      else
        bad("its values cannot be read", "an undamaged file", copy_again);
    }
  }

 private:
  static std::string class_name(matio_classes kind) {
    switch (kind) {
      case MAT_C_CELL:
        return "cell array";
      case MAT_C_STRUCT:
        return "struct";
      case MAT_C_CHAR:
        return "text";
      case MAT_C_SPARSE:
        return "sparse matrix";
      case MAT_C_EMPTY:
        return "variable without value";
      default:
        return kind >= MAT_C_DOUBLE && kind <= MAT_C_UINT64 ? "numeric array"
                                                            : "object or function";
    }
  }

  template <class Take>
  void read_fields(matvar_t* v, Take&& take) {
    char* const* names = Mat_VarGetStructFieldnames(v);
    const unsigned n = Mat_VarGetNumberOfFields(v);
    for (unsigned i = 0; names != nullptr && i < n; ++i) {
      if (const auto text = text_of(Mat_VarGetStructFieldByName(v, names[i], 0)))
        take(names[i], *text);
      else
        sink_.problems().add(in_quotes(fmt::format("{}.{}", v->name, names[i])), "it is no text",
                             "a string in quotes", "Write units.time = \"s\" and so on");
    }
  }

  void read_facts(matvar_t* v) {
    if (v->class_type == MAT_C_STRUCT)
      return read_fields(v,
                         [&](const char* key, const std::string& text) { sink_.fact(key, text); });
    const auto text = text_of(v);
    if (!text)
      return sink_.problems().add("facts", "it is a " + class_name(v->class_type),
                                  "text lines 'key = value', or a struct of strings",
                                  "Correct or remove it");
    std::string_view rest = *text;
    while (!rest.empty()) {
      const auto line = rest.substr(0, rest.find('\n'));
      rest.remove_prefix(std::min(line.size() + 1, rest.size()));
      if (const auto equals = line.find('='); equals != std::string_view::npos)
        sink_.fact(trimmed(line.substr(0, equals)), trimmed(line.substr(equals + 1)));
    }
  }

  RawSink& sink_;
};

}  // namespace

std::optional<std::size_t> count_mat_v5_variables(const std::string& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = in.tellg();
  std::array<char, 4> mark{};
  in.seekg(124).read(mark.data(), 4);
  const bool swapped = mark[2] == 'M';  // "MI" as this machine reads it: written big-endian
  std::size_t count = 0;
  std::streamoff at = 128;
  while (at < size) {
    std::array<std::uint32_t, 2> tag{};
    if (!in.seekg(at).read(reinterpret_cast<char*>(tag.data()), 8)) return std::nullopt;
    if (swapped)
      for (auto& word : tag) word = __builtin_bswap32(word);
    if (tag[0] != MAT_T_MATRIX && tag[0] != MAT_T_COMPRESSED) return std::nullopt;
    at += 8 + static_cast<std::streamoff>(tag[1]);
    ++count;
  }
  return at == size ? std::optional(count) : std::nullopt;
}

void read_mat(const std::string& path, RawSink& sink) {
  const auto damaged = [&](std::string_view what) {
    sink.problems().add("", what, "a complete MATLAB file, v5 to v7.3", copy_again);
  };
  const MatFile file(Mat_Open(path.c_str(), MAT_ACC_RDONLY), Mat_Close);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  if (!file)
    return damaged("the MATLAB file cannot be opened: it is damaged, cut off, or no MATLAB file");
  const auto version = Mat_GetVersion(file.get());
  if (version != MAT_FT_MAT5 && version != MAT_FT_MAT73)
    return sink.problems().add("", "it is no MATLAB file of version 5 or later",
                               "a v5, v7 or v7.3 file", "Save it with -v7 or -v7.3");
  const auto expected = version == MAT_FT_MAT5 ? count_mat_v5_variables(path) : std::nullopt;
  if (version == MAT_FT_MAT5 && !expected) return damaged("the file is damaged or cut off");
  std::size_t count = 0;
  MatReader reader(sink);
  while (true) {
    const Variable v(Mat_VarReadNextInfo(file.get()), Mat_VarFree);
    if (!v) break;
    ++count;
    reader.read(file.get(), v.get());
  }
  if (const std::size_t all = expected.value_or(count); count != all)
    damaged(fmt::format("{} of {} variables can be read", count, all));
}

}  // namespace drift
