#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sediment::segment::onnx {

/// The bytes are no protobuf message, or end within one.
struct WireError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One field of a protobuf message as it lies in the file (https://protobuf.dev/programming-guides/encoding).
struct Field {
  std::uint32_t number = 0;
  std::uint64_t number_value = 0;  ///< of a varint or fixed field
  std::string_view bytes;          ///< of a length-delimited field: text, sub-message or packed values
  std::string_view raw;            ///< key and value, to be copied elsewhere unchanged
};

/// Walks over the fields of a message without copying. ONNX files are read with it and not with OpenCV's or
/// the runtime's own reader, because neither gives both the metadata and the graph.
class WireReader {
 public:
  explicit WireReader(std::string_view message) : rest_(message) {}
  /// False at the end of the message. Throws WireError.
  bool next(Field& field);

 private:
  std::uint64_t varint();
  std::string_view take(std::uint64_t size);

  std::string_view rest_;
};

/// Appends fields to a message under construction.
class WireWriter {
 public:
  WireWriter& number(std::uint32_t field, std::uint64_t value);
  WireWriter& bytes(std::uint32_t field, std::string_view value);
  /// `raw` of a field or of several.
  WireWriter& copy(std::string_view raw);
  const std::string& message() const { return message_; }

 private:
  void varint(std::uint64_t value);

  std::string message_;
};

}  // namespace sediment::segment::onnx
