#pragma once

#include <cstdint>

/// Field numbers of onnx.proto3 (https://github.com/onnx/onnx/blob/main/onnx/onnx.proto3).
namespace sediment::segment::onnx::field {

inline constexpr std::uint32_t kModelGraph = 7, kModelMetadata = 14;
inline constexpr std::uint32_t kGraphNode = 1, kGraphName = 2, kGraphInitializer = 5, kGraphInput = 11,
                               kGraphOutput = 12, kGraphValueInfo = 13;
inline constexpr std::uint32_t kNodeInput = 1, kNodeOutput = 2, kNodeName = 3, kNodeOpType = 4,
                               kNodeAttribute = 5;
inline constexpr std::uint32_t kAttributeName = 1, kAttributeInt = 3;
inline constexpr std::uint32_t kValueName = 1, kValueType = 2;
inline constexpr std::uint32_t kTypeTensor = 1;
inline constexpr std::uint32_t kTensorTypeElement = 1, kTensorTypeShape = 2;
inline constexpr std::uint32_t kShapeDimension = 1;
inline constexpr std::uint32_t kDimensionValue = 1;
inline constexpr std::uint32_t kEntryKey = 1, kEntryValue = 2;
inline constexpr std::uint32_t kTensorName = 8;

}  // namespace sediment::segment::onnx::field
