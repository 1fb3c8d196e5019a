// Ray files, and how fast Embree answers them one ray at a time.
#pragma once

#include <string>

#include "tracer.h"

// Writes `bounces.rays` and `occlusion.rays` into a folder: `per_pixel` of each for every pixel
// whose middle shows a leaf. Bounces leave the hit cosine-distributed to either side, occlusion
// rays go to the sky, evenly over the upper hemisphere.
void write_rays(const World& world, const Facts& facts, int per_pixel, const std::string& folder);

// Traces a file of rays on one thread `rounds` times and prints the rates as JSON.
void print_rates(const World& world, const std::string& file, bool occlusion, int rounds);
