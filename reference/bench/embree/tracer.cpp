#include "tracer.h"

#include <atomic>
#include <chrono>
#include <thread>

namespace {

constexpr float FAR = 1e30f;
constexpr int TILE = 16;
// Paths may end by roulette from this bounce on.
constexpr int ROULETTE_FROM = 3;

bool escapes(RTCScene scene, Vec from, Vec direction, float end, unsigned long long& rays) {
    RTCRay ray = ray_from(from, direction, end).ray;
    ++rays;
    rtcOccluded1(scene, &ray, nullptr);
    return ray.tfar >= 0.0f;
}

}  // namespace

Camera::Camera(const Facts& facts)
    : width(static_cast<int>(numbers(facts, "size", 2)[0])),
      height(static_cast<int>(numbers(facts, "size", 2)[1])),
      position(vector(facts, "camera_position")) {
    const Vec forward = normalised(vector(facts, "camera_look_at") - position);
    const Vec right = normalised(cross(forward, vector(facts, "camera_up")));
    const Vec up = cross(right, forward);
    const float fov = numbers(facts, "camera_vertical_fov_deg", 1)[0] * PI / 180.0f;
    // One pixel, at distance 1.
    const float pixel = 2.0f * std::tan(0.5f * fov) / static_cast<float>(height);
    across = pixel * right;
    down = -pixel * up;
    corner = forward - 0.5f * static_cast<float>(width) * across -
             0.5f * static_cast<float>(height) * down;
}

RTCRayHit Camera::ray(float x, float y) const {
    return ray_from(position, normalised(corner + x * across + y * down), FAR);
}

RTCRayHit ray_from(Vec from, Vec direction, float end) {
    RTCRayHit ray = {};
    ray.ray.org_x = from.x, ray.ray.org_y = from.y, ray.ray.org_z = from.z;
    ray.ray.dir_x = direction.x, ray.ray.dir_y = direction.y, ray.ray.dir_z = direction.z;
    ray.ray.tfar = end;
    ray.ray.mask = ~0u;
    ray.hit.geomID = ray.hit.instID[0] = ray.hit.instPrimID[0] = RTC_INVALID_GEOMETRY_ID;
    return ray;
}

Tracer::Tracer(const World& world, const Facts& facts)
    : world_(world),
      camera_(facts),
      reflectance_(vector(facts, "leaf_reflectance")),
      transmittance_(vector(facts, "leaf_transmittance")),
      ground_(numbers(facts, "ground_reflectance", 1)[0]),
      white_(numbers(facts, "rgb_of_light", 1)[0]),
      lamp_(facts.count("lamp_radiance") != 0) {
    if (lamp_) {
        const auto& c = numbers(facts, "lamp_corners", 12);
        lamp_corner_ = {c[0], c[1], c[2]};
        lamp_along_ = Vec{c[3], c[4], c[5]} - lamp_corner_;
        lamp_across_ = Vec{c[9], c[10], c[11]} - lamp_corner_;
        const Vec normal = cross(lamp_along_, lamp_across_);
        lamp_area_ = std::sqrt(dot(normal, normal));
        lamp_normal_ = normalised(normal);
        lamp_radiance_ = white_ * numbers(facts, "lamp_radiance", 1)[0];
        return;
    }
    sun_direction_ = vector(facts, "sun_towards");
    const double half = numbers(facts, "sun_angular_diameter_deg", 1)[0] * PI / 360.0;
    sun_cosine_ = static_cast<float>(std::cos(half));
    // Irradiance of a facing surface is radiance times π sin²: radiance over the cap's density.
    const double cap = 4.0 * PI * std::sin(0.5 * half) * std::sin(0.5 * half);
    sun_weight_ = static_cast<float>(white_ * numbers(facts, "sun_irradiance", 1)[0] * cap /
                                     (PI * std::sin(half) * std::sin(half)));
    sky_ = white_ * numbers(facts, "sky_radiance", 1)[0];
}

Vec Tracer::direct(Vec p, Vec n, Vec same_side, Vec other_side, Random& random,
                   unsigned long long& rays) const {
    Vec direction;
    float end = FAR, weight = 0;
    if (lamp_) {
        const float u = random.uniform(), v = random.uniform();
        const Vec to = lamp_corner_ + u * lamp_along_ + v * lamp_across_ - p;
        const float distance = std::sqrt(dot(to, to));
        direction = (1.0f / distance) * to;
        const float facing = -dot(direction, lamp_normal_);
        if (facing <= 0.0f) return {};
        weight = lamp_radiance_ * facing * lamp_area_ / (distance * distance);
        end = distance - 4.0f * OFFSET_M;
    } else {
        direction = cap_direction(sun_direction_, sun_cosine_, random);
        weight = sun_weight_;
    }
    const float cosine = dot(direction, n);
    const Vec albedo = cosine > 0.0f ? same_side : other_side;
    if (greatest(albedo) <= 0.0f) return {};
    const Vec start = p + std::copysign(OFFSET_M, cosine) * n;
    if (!escapes(world_.scene(), start, direction, end, rays)) return {};
    return weight * std::abs(cosine) / PI * albedo;
}

Vec Tracer::radiance(RTCRayHit hit, Random& random, unsigned long long& rays) const {
    Vec sum, throughput = {1, 1, 1};
    for (int bounce = 0;; ++bounce) {
        ++rays;
        rtcIntersect1(world_.scene(), &hit, nullptr);
        if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return sum + sky_ * throughput;
        const Surface surface = world_.surface(hit.hit);
        // The lamp is black and is found by shadow rays alone.
        if (surface == Surface::lamp) return sum;
        const Vec d = {hit.ray.dir_x, hit.ray.dir_y, hit.ray.dir_z};
        const Vec p = Vec{hit.ray.org_x, hit.ray.org_y, hit.ray.org_z} + hit.ray.tfar * d;
        Vec n = world_.normal(hit.hit);
        if (dot(n, d) > 0.0f) n = -1.0f * n;
        const bool leaf = surface == Surface::leaf;
        const Vec r = leaf ? reflectance_ : Vec{ground_, ground_, ground_};
        const Vec t = leaf ? transmittance_ : Vec{};
        sum = sum + throughput * direct(p, n, r, t, random, rays);
        const float share = average(r) / (average(r) + average(t));
        const bool reflected = random.uniform() < share;
        throughput = throughput * (reflected ? (1.0f / share) * r : (1.0f / (1.0f - share)) * t);
        if (bounce + 1 >= ROULETTE_FROM) {
            const float survival = std::min(greatest(throughput), 0.95f);
            if (random.uniform() >= survival) return sum;
            throughput = (1.0f / survival) * throughput;
        }
        const Vec side = reflected ? n : -1.0f * n;
        hit = ray_from(p + OFFSET_M * side, cosine_direction(side, random), FAR);
    }
}

Rendered Tracer::render(int spp, unsigned long long seed, int threads) const {
    const auto began = std::chrono::steady_clock::now();
    const int width = camera_.width, height = camera_.height;
    Rendered rendered;
    rendered.rgb.assign(3 * static_cast<std::size_t>(width) * height, 0.0f);
    const int columns = (width + TILE - 1) / TILE, rows = (height + TILE - 1) / TILE;
    std::atomic<int> next = 0;
    std::atomic<unsigned long long> all_rays = 0;
    const auto work = [&] {
        unsigned long long rays = 0;
        for (int tile; (tile = next++) < columns * rows;) {
            const int left = tile % columns * TILE, upper = tile / columns * TILE;
            for (int y = upper; y < std::min(upper + TILE, height); ++y) {
                for (int x = left; x < std::min(left + TILE, width); ++x) {
                    const auto pixel = static_cast<std::uint64_t>(y) * width + x;
                    Random random(seed, pixel);
                    Vec sum;
                    for (int s = 0; s < spp; ++s) {
                        const float dx = random.uniform(), dy = random.uniform();
                        const auto ray = camera_.ray(static_cast<float>(x) + dx,
                                                     static_cast<float>(y) + dy);
                        sum = sum + radiance(ray, random, rays);
                    }
                    sum = (1.0f / static_cast<float>(spp)) * sum;
                    float* out = &rendered.rgb[3 * pixel];
                    out[0] = sum.x, out[1] = sum.y, out[2] = sum.z;
                }
            }
        }
        all_rays += rays;
    };
    std::vector<std::thread> workers;
    for (int i = 0; i < threads; ++i) workers.emplace_back(work);
    for (auto& worker : workers) worker.join();
    rendered.rays = all_rays;
    rendered.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return rendered;
}
