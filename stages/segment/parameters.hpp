#pragma once

#include <string>
#include <vector>

namespace sediment::segment {

enum class Engine { automatic, onnxruntime, opencv, given };

/// What happens to a frame for which no mask was given.
enum class Missing { error, empty };

/// What happens to a class that the label table does not know.
enum class Unknown { error, keep };

struct Parameters {
  Engine engine = Engine::automatic;
  double confidence = 0.25;
  std::vector<std::string> class_confidence;  ///< "person=0.1": instead of `confidence` for this class
  std::vector<std::string> classes;           ///< kept; empty = all
  double iou = 0.7;
  int max_detections = 300;
  int input_size = 0;  ///< pixels, of networks with a dynamic input; 0 = as the network says
  std::vector<std::string> class_names;  ///< empty = the network's own
  Missing missing = Missing::error;
  Unknown unknown_classes = Unknown::error;
  std::string given_class = "person";  ///< of binary images
};

}  // namespace sediment::segment
