// The bare Embree peer: `peer render`, `peer rays`, `peer rates`. Called by lamina_bench/embree.py.
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <stdexcept>

#include "rates.h"

namespace {

constexpr const char* USAGE =
    "peer render SCENE_FOLDER SPP SEED THREADS OUT.f32   path traces, prints seconds as JSON\n"
    "peer rays SCENE_FOLDER PER_PIXEL OUT_FOLDER         writes bounces.rays and occlusion.rays\n"
    "peer rates LEAF.ply PLACEMENTS.f32|- RAYS closest|occluded fast|robust ROUNDS\n";

double cpu_seconds() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

int whole(const char* word, int least) {
    char* end = nullptr;
    const long value = std::strtol(word, &end, 10);
    if (*word == '\0' || *end != '\0' || value < least || value > 1 << 30)
        throw std::runtime_error(std::string("`") + word + "` is not a whole number of at least " +
                                 std::to_string(least));
    return static_cast<int>(value);
}

// One of two words; whether it is the second.
bool second(const std::string& word, const char* first, const char* other) {
    if (word != first && word != other)
        throw std::runtime_error("`" + word + "` is neither " + first + " nor " + other);
    return word == other;
}

void render(char** words) {
    const auto began = std::chrono::steady_clock::now();
    const std::string folder = words[0];
    const Facts facts = read_facts(folder + "/scene.txt");
    World world(folder + "/leaf.ply", folder + "/placements.f32", false);
    world.add(read_ply(folder + "/ground.ply"), Surface::ground);
    if (facts.count("lamp_radiance")) world.add(read_ply(folder + "/lamp.ply"), Surface::lamp);
    world.commit();
    const Tracer tracer(world, facts);
    const std::chrono::duration<double> start = std::chrono::steady_clock::now() - began;
    const int spp = whole(words[1], 1), seed = whole(words[2], 0), threads = whole(words[3], 1);
    const double before = cpu_seconds();
    const Rendered rendered = tracer.render(spp, static_cast<unsigned long long>(seed), threads);
    const double cpu = cpu_seconds() - before;
    std::ofstream out(words[4], std::ios::binary);
    out.write(reinterpret_cast<const char*>(rendered.rgb.data()),
              static_cast<std::streamsize>(rendered.rgb.size() * sizeof(float)));
    if (!out) throw std::runtime_error(std::string(words[4]) + ": cannot be written");
    std::printf("{\"wall_s\": %.6f, \"cpu_s\": %.6f, \"start_s\": %.6f, \"rays\": %llu}\n",
                rendered.seconds, cpu, start.count(), rendered.rays);
}

void rays(char** words) {
    const std::string folder = words[0];
    World world(folder + "/leaf.ply", folder + "/placements.f32", true);
    world.commit();
    write_rays(world, read_facts(folder + "/scene.txt"), whole(words[1], 1), words[2]);
}

void rates(char** words) {
    const std::string placements = words[1];
    World world(words[0], placements == "-" ? "" : placements, second(words[4], "fast", "robust"));
    world.commit();
    print_rates(world, words[2], second(words[3], "closest", "occluded"), whole(words[5], 1));
}

}  // namespace

int main(int count, char** words) {
    const std::string command = count > 1 ? words[1] : "";
    try {
        if (command == "render" && count == 7) return render(words + 2), 0;
        if (command == "rays" && count == 5) return rays(words + 2), 0;
        if (command == "rates" && count == 8) return rates(words + 2), 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "peer: %s\n", error.what());
        return 1;
    }
    std::fputs(USAGE, stderr);
    return 2;
}
