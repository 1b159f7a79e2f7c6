#include "stages/segment/mask_source.hpp"

#include "pipeline/contract/errors.hpp"
#include "stages/segment/given_source.hpp"
#include "stages/segment/network/network.hpp"
#include "stages/segment/network_source.hpp"

namespace sediment::segment {

std::unique_ptr<MaskSource> open_source(const Parameters& parameters, const Sequence& sequence,
                                        const std::optional<std::filesystem::path>& model,
                                        const std::optional<std::filesystem::path>& masks) {
  Engine engine = parameters.engine;
  if (engine == Engine::automatic) {
    if (!model && !masks) throw contract::UsageError("give a network with --model or masks with --masks");
    const bool given = masks && !model;
    engine = given ? Engine::given : onnxruntime_version().empty() ? Engine::opencv : Engine::onnxruntime;
  }
  if (engine == Engine::given) {
    if (!masks) throw contract::UsageError("engine given needs --masks");
    return open_given_source(parameters, sequence, *masks);
  }
  if (!model) throw contract::UsageError("engines onnxruntime and opencv need --model");
  return open_network_source(parameters, engine, sequence, *model);
}

}  // namespace sediment::segment
