// Vectors, colours, random numbers and the two ways to sample a direction that are needed here.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

struct Vec {
    float x = 0, y = 0, z = 0;
};

inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(Vec a, Vec b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline Vec operator*(float s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
inline float dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec cross(Vec a, Vec b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Vec normalised(Vec a) { return (1.0f / std::sqrt(dot(a, a))) * a; }
inline float greatest(Vec a) { return std::max({a.x, a.y, a.z}); }
inline float average(Vec a) { return (a.x + a.y + a.z) * (1.0f / 3.0f); }

constexpr float PI = 3.14159265358979f;

// PCG32: plain, independent random numbers.
struct Random {
    std::uint64_t state = 0;
    std::uint64_t step = 1;

    Random(std::uint64_t seed, std::uint64_t stream) : step((stream << 1) | 1) {
        next();
        state += seed;
        next();
    }
    std::uint32_t next() {
        const std::uint64_t old = state;
        state = old * 6364136223846793005ULL + step;
        const auto mixed = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
        const auto turn = static_cast<std::uint32_t>(old >> 59);
        return (mixed >> turn) | (mixed << ((32 - turn) & 31));
    }
    // In [0, 1).
    float uniform() { return static_cast<float>(next() >> 8) * 0x1p-24f; }
};

// A direction given in the frame whose third axis is the unit vector `n`.
inline Vec to_world(Vec n, Vec local) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    const Vec s = {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
    const Vec t = {b, sign + n.y * n.y * a, -n.y};
    return local.x * s + local.y * t + local.z * n;
}

// Cosine-distributed about `n`.
inline Vec cosine_direction(Vec n, Random& random) {
    const float u = random.uniform();
    const float r = std::sqrt(u), phi = 2.0f * PI * random.uniform();
    return to_world(n, {r * std::cos(phi), r * std::sin(phi), std::sqrt(1.0f - u)});
}

// Even over the cap of directions about `n` with this cosine of its half angle.
inline Vec cap_direction(Vec n, float least_cosine, Random& random) {
    const float z = 1.0f - random.uniform() * (1.0f - least_cosine);
    const float r = std::sqrt(std::max(0.0f, 1.0f - z * z)), phi = 2.0f * PI * random.uniform();
    return to_world(n, {r * std::cos(phi), r * std::sin(phi), z});
}
