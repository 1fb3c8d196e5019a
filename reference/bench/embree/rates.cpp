#include "rates.h"

#include <time.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace {

constexpr float FAR = 1e30f;

// As it is in a file, little-endian.
struct Record {
    float origin[3], direction[3], end;
};

void append(std::vector<Record>& records, Vec from, Vec direction) {
    records.push_back({{from.x, from.y, from.z}, {direction.x, direction.y, direction.z}, FAR});
}

void write(const std::string& file, const std::vector<Record>& records) {
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(records.data()),
              static_cast<std::streamsize>(records.size() * sizeof(Record)));
    if (!out) throw std::runtime_error(file + ": cannot be written");
}

// Processor time of this thread: what a busy machine leaves alone.
double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void print_list(const char* name, const std::vector<double>& values) {
    std::printf("\"%s\": [", name);
    for (std::size_t i = 0; i < values.size(); ++i) std::printf("%s%.4f", i ? ", " : "", values[i]);
    std::printf("], ");
}

std::vector<RTCRayHit> read(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error(file + ": cannot be read");
    std::vector<RTCRayHit> rays;
    for (Record r; in.read(reinterpret_cast<char*>(&r), sizeof r);)
        rays.push_back(ray_from({r.origin[0], r.origin[1], r.origin[2]},
                                {r.direction[0], r.direction[1], r.direction[2]}, r.end));
    return rays;
}

}  // namespace

void write_rays(const World& world, const Facts& facts, int per_pixel, const std::string& folder) {
    const Camera camera(facts);
    std::vector<Record> bounces, occlusion;
    for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
            auto hit = camera.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
            rtcIntersect1(world.scene(), &hit, nullptr);
            if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
            const Vec d = {hit.ray.dir_x, hit.ray.dir_y, hit.ray.dir_z};
            const Vec p = Vec{hit.ray.org_x, hit.ray.org_y, hit.ray.org_z} + hit.ray.tfar * d;
            const Vec n = world.normal(hit.hit);
            Random random(1, static_cast<std::uint64_t>(y) * camera.width + x);
            for (int i = 0; i < per_pixel; ++i) {
                const Vec side = random.uniform() < 0.5f ? n : -1.0f * n;
                append(bounces, p + OFFSET_M * side, cosine_direction(side, random));
                const Vec sky = cap_direction({0, 0, 1}, 0.0f, random);
                append(occlusion, p + std::copysign(OFFSET_M, dot(sky, n)) * n, sky);
            }
        }
    }
    write(folder + "/bounces.rays", bounces);
    write(folder + "/occlusion.rays", occlusion);
}

void print_rates(const World& world, const std::string& file, bool occlusion, int rounds) {
    const std::vector<RTCRayHit> rays = read(file);
    if (rays.empty()) throw std::runtime_error(file + ": holds no rays");
    const double millions = 1e-6 * static_cast<double>(rays.size());
    unsigned long long hits = 0;
    double distances = 0;
    std::vector<double> by_wall, by_cpu;
    for (int round = 0; round < rounds; ++round) {
        hits = 0, distances = 0;
        const double cpu = thread_seconds();
        const auto began = std::chrono::steady_clock::now();
        for (const RTCRayHit& ray : rays) {
            RTCRayHit hit = ray;
            if (occlusion) {
                rtcOccluded1(world.scene(), &hit.ray, nullptr);
                hits += hit.ray.tfar < 0.0f;
            } else {
                rtcIntersect1(world.scene(), &hit, nullptr);
                if (hit.hit.geomID != RTC_INVALID_GEOMETRY_ID) ++hits, distances += hit.ray.tfar;
            }
        }
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
        by_wall.push_back(millions / took.count());
        by_cpu.push_back(millions / (thread_seconds() - cpu));
    }
    std::printf("{\"rays\": %zu, ", rays.size());
    print_list("mrays_per_s", by_wall);
    print_list("mrays_per_cpu_s", by_cpu);
    std::printf("\"hits\": %llu, \"sum_of_t\": %.6f}\n", hits, distances);
}
