#include "tools/synthesize/catalogue.hpp"

#include <stdexcept>

#include "pipeline/contract/description.hpp"
#include "tools/synthesize/plays.hpp"
#include "tools/synthesize/random.hpp"

namespace sediment::synthetic {
namespace {

struct Entry {
  Title title;
  CameraMotion (*play)(Stage);
  double blackout_from = 1, blackout_to = 1;
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{
      {{"walking", "two people walk through the view; one pushes a chair and later pulls it back", 300},
       play_walking},
      {{"sitting", "two people sit before the desks and talk with their hands", 300}, play_sitting},
      {{"static", "nobody there: a hand-held camera before the desks", 300}, play_static},
      {{"carried-box", "a person carries a box from one desk to the other", 300}, play_carried_box},
      {{"rotation", "as walking, with a camera that turns about all axes", 300}, play_rotation},
      {{"crowd", "a pale room; people close to the rolling camera hide most of the view for a second", 300},
       play_crowd},
      {{"bare", "white walls with hardly anything on them; a person passes before a camera that swings along",
        300},
       play_bare},
      {{"loop", "the camera goes once round the room, looking outward, and returns", 900}, play_loop},
      {{"kidnapped",
        "as static; a fifth of the frames in the middle is black and the camera moves on meanwhile", 300},
       play_kidnapped,
       0.4,
       0.6},
  };
  return all;
}

}  // namespace

const std::vector<Title>& titles() {
  static const std::vector<Title> all = [] {
    std::vector<Title> list;
    for (const Entry& entry : entries()) list.push_back(entry.title);
    return list;
  }();
  return all;
}

Play stage_play(const std::string& name, std::uint64_t seed, double duration_s, double texel_m) {
  std::vector<std::string> names;
  for (const Entry& entry : entries()) {
    names.push_back(entry.title.name);
    if (entry.title.name != name) continue;
    Workshop workshop(hash(seed, 1), texel_m);
    CameraMotion motion = entry.play({workshop, hash(seed, 2), duration_s});
    return {std::move(workshop).finish(), std::move(motion), entry.blackout_from, entry.blackout_to};
  }
  const std::string nearest = contract::nearest_name(name, names);
  std::string message = "there is no scene '" + name + "'";
  if (!nearest.empty()) message += "; did you mean '" + nearest + "'?";
  message += " Scenes:";
  for (const std::string& known : names) message += " " + known;
  throw std::invalid_argument(message);
}

}  // namespace sediment::synthetic
