#include "stages/segment/onnx/wire.hpp"

namespace sediment::segment::onnx {
namespace {

enum WireType : std::uint32_t { kVarint = 0, kFixed64 = 1, kLengthDelimited = 2, kFixed32 = 5 };

std::uint64_t little_endian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

}  // namespace

std::uint64_t WireReader::varint() {
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 64; shift += 7) {
    const auto byte = static_cast<unsigned char>(take(1).front());
    value |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
    if (byte < 0x80) return value;
  }
  throw WireError("a number has more than 64 bits");
}

std::string_view WireReader::take(std::uint64_t size) {
  if (size > rest_.size()) throw WireError("it ends in the middle of a field");
  const std::string_view taken = rest_.substr(0, size);
  rest_.remove_prefix(size);
  return taken;
}

bool WireReader::next(Field& field) {
  if (rest_.empty()) return false;
  const std::string_view from = rest_;
  const std::uint64_t key = varint();
  field = {};
  field.number = static_cast<std::uint32_t>(key >> 3);
  if (field.number == 0) throw WireError("a field has the number 0");
  switch (key & 7) {
    case kVarint:
      field.number_value = varint();
      break;
    case kFixed64:
      field.number_value = little_endian(take(8));
      break;
    case kLengthDelimited:
      field.bytes = take(varint());
      break;
    case kFixed32:
      field.number_value = little_endian(take(4));
      break;
    default:
      throw WireError("a field has an unknown wire type");
  }
  field.raw = from.substr(0, from.size() - rest_.size());
  return true;
}

void WireWriter::varint(std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) message_.push_back(static_cast<char>(value | 0x80));
  message_.push_back(static_cast<char>(value));
}

WireWriter& WireWriter::number(std::uint32_t field, std::uint64_t value) {
  varint(field << 3 | kVarint);
  varint(value);
  return *this;
}

WireWriter& WireWriter::bytes(std::uint32_t field, std::string_view value) {
  varint(field << 3 | kLengthDelimited);
  varint(value.size());
  message_.append(value);
  return *this;
}

WireWriter& WireWriter::copy(std::string_view raw) {
  message_.append(raw);
  return *this;
}

}  // namespace sediment::segment::onnx
