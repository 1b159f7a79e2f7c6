#include "pipeline/runner/slurm/arrays.hpp"

#include <algorithm>
#include <tuple>

namespace sediment::runner::slurm {
namespace {

/// Up to here an array per set of elements waited for (afterok): Slurm starts those at once. What follows an
/// array index by index (aftercorr) takes few calls for any number, but Slurm looks at it only every half
/// minute.
constexpr std::size_t kMostPromptArrays = 64;

using Set = std::vector<std::size_t>;

/// Puts elements into arrays, layer by layer.
class Arranging {
 public:
  Arranging(const std::vector<Element>& elements, std::size_t most_tasks)
      : elements_(elements),
        most_tasks_(most_tasks),
        array_of_(elements.size()),
        index_of_(elements.size()) {}

  void arrange(std::size_t layer, const Set& members) {
    std::map<std::tuple<Set, std::vector<std::string>, Request>, Set> same;  ///< by what they wait for
    for (const std::size_t e : members)
      same[{elements_[e].waits_for, elements_[e].waits_for_jobs, elements_[e].request}].push_back(e);
    const bool prompt = same.size() <= kMostPromptArrays;
    std::map<std::tuple<Set, Request, std::size_t>, std::size_t> ranked;  ///< number of the array
    std::map<std::tuple<Set, Request, std::size_t>, std::size_t> ranks;   ///< used of an index
    for (const auto& [what, all] : same) {
      const auto index = common_index(all.front());
      if (prompt || !index) {
        add_prompt(layer, all);
        continue;
      }
      const Set follows = arrays_before(all.front());
      for (const std::size_t e : all) {
        const std::size_t rank = ranks[{follows, elements_[e].request, *index}]++;
        const auto [found, fresh] = ranked.try_emplace({follows, elements_[e].request, rank}, arrays.size());
        if (fresh) arrays.push_back({follows, {}, {}, elements_[e].request, layer, {}});
        place(e, found->second, *index);
      }
    }
  }

  std::vector<Array> arrays;

 private:
  /// The index of all that an element waits for, if they share one.
  std::optional<std::size_t> common_index(std::size_t e) const {
    const Element& element = elements_[e];
    if (element.waits_for.empty() || !element.waits_for_jobs.empty()) return std::nullopt;
    const std::size_t index = index_of_[element.waits_for.front()];
    for (const std::size_t before : element.waits_for)
      if (index_of_[before] != index) return std::nullopt;
    return index;
  }

  Set arrays_before(std::size_t e) const {
    Set all;
    for (const std::size_t before : elements_[e].waits_for) all.push_back(array_of_[before]);
    std::sort(all.begin(), all.end());
    return all;
  }

  void add_prompt(std::size_t layer, const Set& all) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Element& element = elements_[all[i]];
      if (i % most_tasks_ == 0)
        arrays.push_back({{}, element.waits_for, element.waits_for_jobs, element.request, layer, {}});
      place(all[i], arrays.size() - 1, i % most_tasks_);
    }
  }

  void place(std::size_t e, std::size_t array, std::size_t index) {
    array_of_[e] = array;
    index_of_[e] = index;
    arrays[array].tasks.emplace_back(index, e);
  }

  const std::vector<Element>& elements_;
  std::size_t most_tasks_;
  std::vector<std::size_t> array_of_, index_of_;
};

}  // namespace

std::vector<Array> arrays_of(const std::vector<Element>& elements, std::size_t most_tasks) {
  std::map<std::size_t, Set> layers;
  for (std::size_t e = 0; e < elements.size(); ++e) layers[elements[e].layer].push_back(e);
  Arranging arranging(elements, most_tasks);
  for (const auto& [layer, members] : layers) arranging.arrange(layer, members);
  for (Array& array : arranging.arrays) std::sort(array.tasks.begin(), array.tasks.end());
  return std::move(arranging.arrays);
}

std::string index_text(const Array& array) {
  std::string text;
  for (std::size_t i = 0; i < array.tasks.size();) {
    std::size_t last = i;
    while (last + 1 < array.tasks.size() && array.tasks[last + 1].first == array.tasks[last].first + 1)
      ++last;
    text += (text.empty() ? "" : ",") + std::to_string(array.tasks[i].first);
    if (last > i) text += '-' + std::to_string(array.tasks[last].first);
    i = last + 1;
  }
  return text;
}

}  // namespace sediment::runner::slurm
