#pragma once

#include <cstdint>

#include "tools/synthesize/texture.hpp"

namespace sediment::synthetic {

// What surfaces of a room look like. All are drawn from a seed, at several scales, without anything finer
// than a texel.

/// Painted plaster: cloudy, with grains, scuffs and small marks. `contrast` 1 is a lively wall, 0 a bare one.
Pattern plaster(std::uint64_t seed, Rgb color, double contrast = 1);
Pattern wood(std::uint64_t seed, Rgb color);
/// Carpet tiles of half a metre in slightly different tones, with speckles.
Pattern carpet(std::uint64_t seed, Rgb color);
/// Panels of 0.6 m with joints and pinholes.
Pattern ceiling_panels(std::uint64_t seed);
/// A print: coloured fields, shapes, a headline and lines of text.
Pattern poster(std::uint64_t seed, double width_m, double height_m);
/// Sheets of paper pinned to cork.
Pattern pin_board(std::uint64_t seed, double width_m, double height_m);
/// A computer screen with windows full of text and a picture.
Pattern screen(std::uint64_t seed, double width_m, double height_m);
Pattern keyboard(std::uint64_t seed, double width_m, double height_m);
/// White enamel with writing and drawings in several colours.
Pattern whiteboard(std::uint64_t seed, double width_m, double height_m);
/// The dial of a clock, 0.28 m wide.
Pattern clock_face();
/// Back of a book: bands, title, publisher's mark.
Pattern book_spine(std::uint64_t seed, double width_m, double height_m);
/// Brown board with a tape, a label and print.
Pattern cardboard(std::uint64_t seed, double width_m, double height_m);
/// Woven cloth; `stripes` 0 plain, 1 horizontal stripes, 2 checks.
Pattern cloth(std::uint64_t seed, Rgb color, int stripes);
/// Cork, stone, terrazzo: a colour with dark and light specks of one to three centimetres.
Pattern speckled(std::uint64_t seed, Rgb color);
/// Fine irregular grain of plastic, metal and skin, nearly white: meant to be tinted.
Pattern grain(std::uint64_t seed, double strength);

}  // namespace sediment::synthetic
