// How many rays a second Embree 4 answers on one thread, by its functions for single rays, on the
// files that candela.jmh.RayKernels writes. Prints the same lines as that program.
//
//   g++ -O3 -march=native -I EMBREE/include rays.cpp -o rays -L EMBREE/lib -lembree4
//   ./rays FOLDER [seconds]

#include <embree4/rtcore.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <string>
#include <vector>

static double cpu() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return t.tv_sec + t.tv_nsec * 1e-9;
}

template <class T> static std::vector<T> read(FILE *in, size_t count) {
  std::vector<T> all(count);
  if (fread(all.data(), sizeof(T), count, in) != count) {
    fprintf(stderr, "the file is too short\n");
    exit(1);
  }
  return all;
}

static FILE *open(const std::string &path) {
  FILE *in = fopen(path.c_str(), "rb");
  if (!in) {
    fprintf(stderr, "can't open %s\n", path.c_str());
    exit(1);
  }
  return in;
}

struct Result {
  int hits;
  double sum;
};

static Result pass(RTCScene scene, const std::vector<float> &f, bool anyHit) {
  Result r{0, 0};
  RTCRayHit q;
  for (size_t i = 0; i < f.size(); i += 7) {
    RTCRay &ray = q.ray;
    ray.org_x = f[i], ray.org_y = f[i + 1], ray.org_z = f[i + 2];
    ray.dir_x = f[i + 3], ray.dir_y = f[i + 4], ray.dir_z = f[i + 5];
    ray.tnear = 0, ray.tfar = f[i + 6];
    ray.time = 0, ray.mask = ~0u, ray.id = 0, ray.flags = 0;
    if (anyHit) {
      rtcOccluded1(scene, &ray);
      if (ray.tfar < 0) r.hits++;
    } else {
      q.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      q.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene, &q);
      if (q.hit.geomID != RTC_INVALID_GEOMETRY_ID) r.hits++, r.sum += ray.tfar;
    }
  }
  return r;
}

int main(int argc, char **argv) {
  if (argc < 2) {
    fprintf(stderr, "usage: rays FOLDER [seconds]\n");
    return 1;
  }
  const std::string folder = argv[1];
  const double seconds = argc > 2 ? atof(argv[2]) : 3;
  FILE *in = open(folder + "/mesh.bin");
  auto size = read<int32_t>(in, 2);
  auto positions = read<float>(in, size_t(3) * size[0]);
  auto indices = read<int32_t>(in, size_t(3) * size[1]);
  fclose(in);
  RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
  for (int robust = 0; robust < 2; robust++) {
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void *v = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12,
                                      size[0]);
    std::copy(positions.begin(), positions.end(), (float *)v);
    void *t = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12,
                                      size[1]);
    std::copy(indices.begin(), indices.end(), (int32_t *)t);
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene, mesh);
    const double start = cpu();
    rtcCommitScene(scene);
    const char *name = robust ? "embree robust" : "embree";
    printf("# %s: %d triangles, built in %.2f s\n", name, size[1], cpu() - start);
    for (const char *set : {"camera", "bounce", "shadow"}) {
      FILE *rays = open(folder + "/" + set + ".bin");
      auto head = read<int32_t>(rays, 2);
      auto floats = read<float>(rays, size_t(7) * head[0]);
      fclose(rays);
      Result r = pass(scene, floats, head[1]);
      double best = std::numeric_limits<double>::infinity();
      for (const double begin = cpu(); cpu() - begin < seconds;) {
        const double from = cpu();
        r = pass(scene, floats, head[1]);
        best = std::fmin(best, cpu() - from);
      }
      printf("c++\t%s\t%s\t%.3f\t%d\t%.1f\t0.00\n", name, set, head[0] / best * 1e-6, r.hits, r.sum);
      fflush(stdout);
    }
    rtcReleaseGeometry(mesh);
    rtcReleaseScene(scene);
  }
  rtcReleaseDevice(device);
}
