// A bare path tracer: RGB, plain random numbers, sun or lamp by a shadow ray, sky by the bounce.
#pragma once

#include <string>
#include <vector>

#include "scene.h"

struct Camera {
    explicit Camera(const Facts& facts);
    // Through the point (x, y) of the picture, in pixels from its upper left corner.
    RTCRayHit ray(float x, float y) const;

    int width, height;
    Vec position, across, down, corner;
};

// Starts a ray at `from`, ending at `end`.
RTCRayHit ray_from(Vec from, Vec direction, float end);
// Rays start this far from the surface that they leave, in metres.
constexpr float OFFSET_M = 1e-5f;

struct Rendered {
    std::vector<float> rgb;
    double seconds = 0;
    unsigned long long rays = 0;
};

class Tracer {
   public:
    Tracer(const World& world, const Facts& facts);
    Rendered render(int spp, unsigned long long seed, int threads) const;

   private:
    Vec radiance(RTCRayHit hit, Random& random, unsigned long long& rays) const;
    Vec direct(Vec p, Vec n, Vec same_side, Vec other_side, Random& random,
               unsigned long long& rays) const;

    const World& world_;
    Camera camera_;
    Vec reflectance_, transmittance_;
    float ground_, white_;
    // Sun and sky, or a lamp.
    bool lamp_;
    Vec sun_direction_, lamp_corner_, lamp_along_, lamp_across_, lamp_normal_;
    float sun_cosine_ = 1, sun_weight_ = 0, sky_ = 0, lamp_radiance_ = 0, lamp_area_ = 0;
};
