#include "stages/repair/vote.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <set>

#include "stages/repair/trails.hpp"

namespace sediment::repair {
namespace {

constexpr float kLeastShare = 0.05F;  ///< pixels below this are left to the background
constexpr double kQuorum = 0.1;       ///< of the votes that could be: fewer are no full share
constexpr int kMargin_px = 16;        ///< around the votes: what snapping may look at

/// The votes on one track, on the grid.
struct Ballot {
  std::vector<float> votes, weights;
  double score_sum = 0, weight_sum = 0;
  int voters = 0;  ///< in the current direction
};

class Election {
 public:
  Election(const Clip& clip, std::size_t frame_idx, const VoteParameters& parameters,
           const std::function<bool(int)>& may_appear)
      : clip_(clip), frame_(clip.at(frame_idx)), parameters_(parameters), may_appear_(may_appear) {
    const PixelTrails here = start_trails(frame_.depth, kStep_px);
    columns_ = here.columns;
    rows_ = here.rows;
    for (std::size_t i = 0; i < frame_.track_of.size(); ++i)
      if (frame_.trusted[i]) own_.insert(frame_.track_of[i]);
    collect(frame_, here, 0);
  }

  /// Collects votes along the trails in one direction.
  void ask(Direction direction, double depth_scale) {
    for (auto& [track, ballot] : ballots_) ballot.voters = 0;
    walk(clip_, frame_.frame_idx, direction, farthest_voter(direction), kStep_px, depth_scale,
         [&](const ClipFrame& other, const PixelTrails& trails) {
           collect(other, trails,
                   std::abs(static_cast<int>(other.frame_idx) - static_cast<int>(frame_.frame_idx)));
           return true;
         });
  }

  std::vector<SoftMask> count() const {
    std::vector<SoftMask> masks;
    for (const auto& [track, ballot] : ballots_) {
      const cv::Rect where = extent_of(ballot);
      if (where.empty()) continue;
      masks.push_back({track, ballot.score_sum / ballot.weight_sum, where, share_of(ballot, where)});
    }
    return masks;
  }

 private:
  bool may_vote(int track, int distance, int voters_before) const {
    if (own_.contains(track)) return distance <= parameters_.neighbors;
    return distance <= parameters_.max_gap && voters_before < std::max(1, parameters_.neighbors) &&
           may_appear_(track);
  }

  /// Distance of the last frame in a direction in which somebody votes: trails beyond it cost for nothing.
  int farthest_voter(Direction direction) const {
    std::map<int, int> voters;
    int farthest = 0;
    for (int distance = 1; distance <= std::max(parameters_.max_gap, parameters_.neighbors); ++distance) {
      const std::size_t at =
          frame_.frame_idx + static_cast<std::size_t>(distance * static_cast<int>(direction));
      if (!clip_.has(at)) break;
      const ClipFrame& other = clip_.at(at);
      for (std::size_t i = 0; i < other.track_of.size(); ++i) {
        const int track = other.track_of[i];
        if (!other.trusted[i] || !may_vote(track, distance, voters[track])) continue;
        ++voters[track];
        farthest = distance;
      }
    }
    return farthest;
  }

  void collect(const ClipFrame& other, const PixelTrails& trails, int distance) {
    const auto weight = static_cast<float>(std::pow(parameters_.decay, distance));
    std::vector<Ballot*> ballot_of_id;
    std::vector<Ballot*> open;
    for (std::size_t i = 0; i < other.track_of.size(); ++i) {
      const int track = other.track_of[i];
      const auto known = ballots_.find(track);
      const int voters = known == ballots_.end() ? 0 : known->second.voters;
      if (!other.trusted[i] || !may_vote(track, distance, voters)) continue;
      const Instance& instance = other.detections.instances[i];
      Ballot& ballot = ballots_[track];
      ballot.votes.resize(trails.size());
      ballot.weights.resize(trails.size());
      ballot.score_sum += weight * instance.score;
      ballot.weight_sum += weight;
      ++ballot.voters;
      open.push_back(&ballot);
      ballot_of_id.resize(std::max(ballot_of_id.size(), static_cast<std::size_t>(instance.id) + 1));
      ballot_of_id[static_cast<std::size_t>(instance.id)] = &ballot;
    }
    for (Ballot* ballot : open)
      for (std::size_t i = 0; i < trails.size(); ++i)
        ballot->weights[i] += trails.valid[i] ? weight * trails.trust[i] : 0;
    for (std::size_t i = 0; i < trails.size() && !open.empty(); ++i) {
      if (!trails.valid[i]) continue;
      const auto id = trails.nearest<std::uint16_t>(other.detections.ids, i);
      if (id < ballot_of_id.size() && ballot_of_id[id])
        ballot_of_id[id]->votes[i] += weight * trails.trust[i];
    }
  }

  /// The part of the image around the pixels with votes.
  cv::Rect extent_of(const Ballot& ballot) const {
    int left = columns_, right = -1, top = rows_, bottom = -1;
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column) {
        const auto i = static_cast<std::size_t>(row) * columns_ + column;
        if (ballot.votes[i] <= kLeastShare * ballot.weights[i]) continue;
        left = std::min(left, column);
        right = std::max(right, column);
        top = std::min(top, row);
        bottom = row;
      }
    if (right < 0) return {};
    const cv::Rect voted(left * kStep_px - kMargin_px, top * kStep_px - kMargin_px,
                         (right - left + 1) * kStep_px + 2 * kMargin_px,
                         (bottom - top + 1) * kStep_px + 2 * kMargin_px);
    return voted & cv::Rect(0, 0, frame_.depth.cols, frame_.depth.rows);
  }

  cv::Mat share_of(const Ballot& ballot, const cv::Rect& where) const {
    cv::Mat grid(rows_, columns_, CV_32FC1), full;
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column) {
        const auto i = static_cast<std::size_t>(row) * columns_ + column;
        const auto quorum = static_cast<float>(kQuorum * ballot.weight_sum);
        grid.at<float>(row, column) =
            ballot.weights[i] > 0 ? ballot.votes[i] / std::max(ballot.weights[i], quorum) : 0;
      }
    cv::resize(grid, full, {columns_ * kStep_px, rows_ * kStep_px}, 0, 0, cv::INTER_LINEAR);
    return full(where).clone();
  }

  const Clip& clip_;
  const ClipFrame& frame_;
  const VoteParameters& parameters_;
  const std::function<bool(int)>& may_appear_;
  int columns_ = 0, rows_ = 0;
  std::set<int> own_;  ///< tracks that the frame itself has detected
  std::map<int, Ballot> ballots_;
};

}  // namespace

std::vector<SoftMask> vote(const Clip& clip, std::size_t frame_idx, double depth_scale,
                           const VoteParameters& parameters,
                           const std::function<bool(int track)>& may_appear) {
  Election election(clip, frame_idx, parameters, may_appear);
  election.ask(Direction::backward, depth_scale);
  election.ask(Direction::forward, depth_scale);
  return election.count();
}

}  // namespace sediment::repair
