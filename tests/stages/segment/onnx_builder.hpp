#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "stages/segment/onnx/wire.hpp"

namespace sediment::test {

/// Writes ONNX graphs node by node. Tensors are known by their names.
class OnnxBuilder {
 public:
  struct Attribute {
    std::string name;
    std::vector<std::int64_t> values;
    bool list = true;
  };

  void floats(const std::string& name, const std::vector<std::int64_t>& shape,
              const std::vector<float>& values);
  void integers(const std::string& name, const std::vector<std::int64_t>& values);
  void node(const std::string& op_type, const std::vector<std::string>& inputs,
            const std::vector<std::string>& outputs, const std::vector<Attribute>& attributes = {});
  /// A size of -1 is dynamic.
  void input(const std::string& name, int element_type, const std::vector<std::int64_t>& shape);
  void output(const std::string& name, const std::vector<std::int64_t>& shape);
  void metadata(const std::string& key, const std::string& value);

  /// The whole file, with opset 13.
  std::string file() const;

 private:
  segment::onnx::WireWriter graph_, model_tail_;
};

}  // namespace sediment::test
