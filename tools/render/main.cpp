#include <CLI/CLI.hpp>
#include <iostream>
#include <sstream>

#include "tools/render/picture_file.hpp"
#include "tools/render/pictures.hpp"

using namespace sediment;
using namespace sediment::render;

namespace {

constexpr const char* kAbout =
    "Pictures of what the pipeline made, without a display.\n\n"
    "  render cloud OUT/voxel --ground OUT/project2d --color label --out cloud.png\n"
    "  render cloud OUT/voxel --view top --max-height 2 --ground OUT/project2d --out top.png\n"
    "  render cloud OUT/fuse --view pose --pose \"0 0 -1  0 0 0 1\" --out from_behind.png\n"
    "  render octree OUT/octree --ground OUT/project2d --color height --out octree.png\n"
    "  render grid OUT/project2d --out grid.png\n"
    "  render masks --sequence sequence.yaml --masks OUT/segment --dynamic OUT/interaction-mask --frames "
    "10,80 --out masks.png\n"
    "  render trajectory OUT/track --truth groundtruth.txt --out trajectory.png\n\n"
    "`render WHAT --help` lists the options of each.";

/// Everything the command line can say.
struct Call {
  std::string path, out, pose, size = "1280x960", view = "oblique", color = "image", grid_title;
  MapOptions map;
  MaskOptions masks;
  TrajectoryOptions trajectory;
  int max_depth = 16, least_px = 900;
};

cv::Size size_from(const std::string& text) {
  int width = 0, height = 0;
  char x = 0;
  std::istringstream stream(text);
  std::string more;
  if (!(stream >> width >> x >> height) || x != 'x' || stream >> more || width < 64 || height < 64 ||
      width > 16384 || height > 16384)
    throw CLI::ValidationError("--size",
                               "expected WIDTHxHEIGHT between 64 and 16384, found \"" + text + "\"");
  return {width, height};
}

Pose pose_from(const std::string& text) {
  std::istringstream stream(text);
  Vec3 t;
  Quaternion q;
  std::string more;
  if (!(stream >> t.x >> t.y >> t.z >> q.x >> q.y >> q.z >> q.w) || stream >> more)
    throw CLI::ValidationError("--pose", "expected \"tx ty tz qx qy qz qw\", found \"" + text + "\"");
  return sediment::pose_from(q, t);
}

void add_map_options(CLI::App& app, Call& call) {
  MapOptions& map = call.map;
  app.add_option("--view", call.view, "top: from above, to scale; oblique: in perspective; pose: from --pose")
      ->capture_default_str()
      ->check(CLI::IsMember({"top", "oblique", "pose"}));
  app.add_option("--color", call.color,
                 "image: as stored; label: by class, with a legend; height: above the ground")
      ->capture_default_str()
      ->check(CLI::IsMember({"image", "label", "height"}));
  app.add_option("--ground", map.ground,
                 "folder of project2d or its ground.json: where up is and where height 0");
  app.add_option(
      "--up", map.up,
      "without --ground: upward direction in the world, \"x y z\" [0 -1 0: that of a first camera]");
  app.add_option("--max-height", map.max_height_m,
                 "cut off what is higher, metres, to look into a room [0: nothing]");
  app.add_option("--azimuth", map.view.azimuth_deg, "oblique: direction of view, degrees about the vertical")
      ->capture_default_str();
  app.add_option("--elevation", map.view.elevation_deg, "oblique: degrees above the horizon")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 89.0));
  app.add_option("--zoom", map.view.zoom, "comes closer above 1")
      ->capture_default_str()
      ->check(CLI::Range(0.01, 100.0));
  app.add_option("--pose", call.pose, "camera to world as in a trajectory file: \"tx ty tz qx qy qz qw\"");
  app.add_option("--fov", map.view.field_of_view_deg, "pose: horizontal field of view, degrees")
      ->capture_default_str()
      ->check(CLI::Range(1.0, 170.0));
  app.add_option("--size", call.size, "of the picture, pixels")->capture_default_str();
  app.add_option("--shading", map.shading, "strength of eye-dome lighting, 0 = flat")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 20.0));
  app.add_option("--title", map.title, "text in the upper left corner");
}

void complete(Call& call) {
  call.map.view.size = size_from(call.size);
  call.map.view.direction = call.view == "top"    ? Direction::top
                            : call.view == "pose" ? Direction::pose
                                                  : Direction::oblique;
  call.map.color = call.color == "label"    ? ColorBy::label
                   : call.color == "height" ? ColorBy::height
                                            : ColorBy::image;
  if (call.map.view.direction != Direction::pose) return;
  if (call.pose.empty()) throw CLI::RequiredError("--view pose: --pose");
  call.map.view.world_from_camera = pose_from(call.pose);
}

/// Declares the five kinds of pictures; each returns its picture.
cv::Mat picture_of(CLI::App& app, int argc, char** argv, Call& call) {
  CLI::App* cloud = app.add_subcommand("cloud", "a cloud: points as discs, lit so that shape shows");
  cloud->add_option("CLOUD", call.path, "folder of a cloud (fuse, sor, voxel) or a PCD file")
      ->required()
      ->check(CLI::ExistingPath);
  cloud->add_option("--point-size", call.map.point_size_m,
                    "diameter of a point, metres [0: from the spacing]");
  add_map_options(*cloud, call);
  CLI::App* octree = app.add_subcommand("octree", "an octree: occupied leaves as cubes");
  octree->add_option("OCTREE", call.path, "folder of an octree")->required()->check(CLI::ExistingDirectory);
  octree->add_option("--max-depth", call.max_depth, "of the leaves drawn; less than 16 is coarser")
      ->capture_default_str()
      ->check(CLI::Range(1, 16));
  add_map_options(*octree, call);
  CLI::App* grid = app.add_subcommand("grid", "a navigation grid, with metres");
  grid->add_option("GRID", call.path, "folder of a grid map")->required()->check(CLI::ExistingDirectory);
  grid->add_option("--pixels", call.least_px, "least size of the longer side")
      ->capture_default_str()
      ->check(CLI::Range(64, 16384));
  grid->add_option("--title", call.grid_title, "text in the upper left corner");
  CLI::App* masks = app.add_subcommand("masks", "frames with their instances and what is dynamic in them");
  masks->add_option("--sequence", call.masks.sequence, "the sequence's YAML file")
      ->required()
      ->check(CLI::ExistingPath);
  masks->add_option("--masks", call.masks.masks, "folder of segment: instances in their classes' colours")
      ->check(CLI::ExistingDirectory);
  masks->add_option("--dynamic", call.masks.dynamic, "folder of interaction-mask: dynamic pixels, hatched")
      ->check(CLI::ExistingDirectory);
  masks
      ->add_option("--frames", call.masks.frames,
                   "numbers from 0 or colour stamps, by commas [six spread over the sequence]")
      ->delimiter(',');
  masks->add_option("--columns", call.masks.columns, "pictures in a row")
      ->capture_default_str()
      ->check(CLI::Range(1, 20));
  masks->add_option("--title", call.masks.title, "text in the upper left corner");
  CLI::App* trajectory =
      app.add_subcommand("trajectory", "a camera's path from above, against the truth if there is one");
  trajectory
      ->add_option("TRAJECTORY", call.trajectory.estimate, "folder of a trajectory or a file in TUM format")
      ->required()
      ->check(CLI::ExistingPath);
  trajectory
      ->add_option("--truth", call.trajectory.truth,
                   "the same of the truth: the estimate is aligned and coloured by its error")
      ->check(CLI::ExistingPath);
  trajectory->add_option("--up", call.trajectory.up,
                         "upward direction, \"x y z\" [0 0 1 with a truth, else 0 -1 0]");
  trajectory->add_option("--title", call.trajectory.title, "text in the upper left corner");
  for (CLI::App* sub : {cloud, octree, grid, masks, trajectory})
    sub->add_option("--out", call.out, "the picture to write: .png, or .jpg where it should be small")
        ->required();
  app.require_subcommand(1);

  app.parse(argc, argv);
  if (*cloud || *octree) complete(call);
  if (*cloud) return cloud_picture(call.path, call.map);
  if (*octree) return octree_picture(call.path, call.max_depth, call.map);
  if (*grid) return grid_picture(call.path, call.least_px, call.grid_title);
  if (*masks) return mask_picture(call.masks);
  return trajectory_picture(call.trajectory);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(kAbout, "render");
  Call call;
  try {
    const cv::Mat picture = picture_of(app, argc, argv, call);
    write_picture(call.out, picture);
    std::cout << call.out << ": " << picture.cols << " x " << picture.rows << '\n';
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    std::cerr << "render: " << error.what() << '\n';
    return 1;
  }
}
