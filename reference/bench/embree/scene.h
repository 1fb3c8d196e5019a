// A scene's folder (written by lamina_bench/write.py) and its Embree scene.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "interface.h"
#include "maths.h"

struct Mesh {
    std::vector<Vec> positions;
    std::vector<std::uint32_t> corners;
};

// Local to world, row by row.
struct Placement {
    float m[12];

    Vec point(Vec p) const {
        return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3],
                m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
                m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
    }
    // Placements are rotations: normals turn as directions do.
    Vec direction(Vec d) const {
        return {m[0] * d.x + m[1] * d.y + m[2] * d.z, m[4] * d.x + m[5] * d.y + m[6] * d.z,
                m[8] * d.x + m[9] * d.y + m[10] * d.z};
    }
};

// Lines of `scene.txt`: a name and its numbers.
using Facts = std::map<std::string, std::vector<float>>;

Mesh read_ply(const std::string& file);
std::vector<Placement> read_placements(const std::string& file);
Facts read_facts(const std::string& file);
// The numbers of `name`, of which there must be `count`.
const std::vector<float>& numbers(const Facts& facts, const std::string& name, std::size_t count);
Vec vector(const Facts& facts, const std::string& name);

// What is hit: who owns the geometry, with its normal in the world.
enum class Surface { leaf, ground, lamp };

class World {
   public:
    // Leaves alone, as ray rates are measured; `ground` and `lamp` add meshes of those names.
    World(const std::string& leaf_ply, const std::string& placements, bool robust);
    ~World();
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    void add(const Mesh& mesh, Surface surface);
    void commit();

    RTCScene scene() const { return scene_; }
    Surface surface(const RTCHit& hit) const;
    // The unit geometric normal in the world.
    Vec normal(const RTCHit& hit) const;

   private:
    unsigned attach(RTCScene scene, const Mesh& mesh) const;
    void check(const char* what) const;

    RTCDevice device_;
    RTCScene scene_;
    RTCScene leaf_scene_ = nullptr;
    std::vector<Placement> placements_;
    std::vector<Surface> surfaces_;
};
