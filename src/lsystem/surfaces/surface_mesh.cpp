#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cmath>

#include <espalier/environment/ply_counts.h>
#include <espalier/lsystem/strings/source.h>
#include <espalier/lsystem/surfaces/surface_mesh.h>

namespace espalier::lsystem {

namespace {

constexpr std::size_t kMostTriangles = 100'000;

/// A disk without files.
class NoFiles : public Assimp::IOSystem {
 public:
  bool Exists(const char*) const override { return false; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char*, const char*) override { return nullptr; }
  void Close(Assimp::IOStream*) override {}
};

bool is_finite(const aiVector3D& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void append_faces(const aiMesh& mesh, const std::string& label, std::vector<Triangle>& triangles) {
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices != 3) continue;
    if (triangles.size() >= kMostTriangles)
      throw_input_error("surface \"{}\": got more than {} triangles, expected fewer", label, kMostTriangles);
    Triangle triangle;
    for (unsigned k = 0; k < 3; ++k) {
      const aiVector3D& p = mesh.mVertices[face.mIndices[k]];
      if (!is_finite(p)) throw_input_error("surface \"{}\": got a vertex that is not finite", label);
      triangle[k] = {p.x, p.y, p.z};
    }
    triangles.push_back(triangle);
  }
}

}  // namespace

std::vector<Triangle> read_surface_mesh(const std::string& bytes, const std::string& format,
                                        const std::string& label) {
  try {
    check_ply_counts(bytes, bytes.size());
  } catch (const InputError& error) {
    throw_input_error("surface \"{}\": {}", label, error.what());
  }
  Assimp::Importer importer;
  importer.SetIOHandler(new NoFiles);  // which the importer then owns
  const aiScene* scene = importer.ReadFileFromMemory(
      bytes.data(), bytes.size(), aiProcess_Triangulate | aiProcess_PreTransformVertices, format.c_str());
  if (!scene)
    throw InputError(
        one_line(fmt::format("surface \"{}\": expected a mesh: {}", label, importer.GetErrorString()),
                 kLongestMessage));
  std::vector<Triangle> triangles;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) append_faces(*scene->mMeshes[m], label, triangles);
  if (triangles.empty()) throw_input_error("surface \"{}\": got no triangles, expected some", label);
  return triangles;
}

}  // namespace espalier::lsystem
