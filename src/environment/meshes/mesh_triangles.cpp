#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdint>
#include <set>
#include <sstream>

#include <espalier/core/error.h>
#include <espalier/environment/meshes/mesh_triangles.h>
#include <espalier/environment/meshes/ply_head.h>
#include <espalier/machine/child.h>

namespace espalier {

namespace {

/// Of a mesh of so many bytes: a sound one takes a twentieth of it.
ChildLimits limits_for(std::size_t bytes) {
  const double megabytes = static_cast<double>(bytes) / (1 << 20);
  return {.cpu_s = 0.3 + 2 * megabytes,
          .wall_s = 30 + 20 * megabytes,
          .memory_bytes = (std::size_t{128} << 20) + 100 * bytes};
}

/// A disk without files.
class NoFiles : public Assimp::IOSystem {
 public:
  bool Exists(const char*) const override { return false; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char*, const char*) override { return nullptr; }
  void Close(Assimp::IOStream*) override {}
};

bool reads(const aiImporterDesc& importer, const std::string& format) {
  std::istringstream extensions(importer.mFileExtensions);
  for (std::string extension; extensions >> extension;)
    if (extension == format) return true;
  return false;
}

/// Content does not choose among the forty readers of Assimp.
void keep_readers_of(const std::string& format, Assimp::Importer& importer) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;)
    if (const aiImporterDesc* about = importer.GetImporterInfo(i); about && !reads(*about, format))
      importer.UnregisterLoader(importer.GetImporter(i));  // which is then ours: the child ends soon
}

/// Assimp's importers put what was thrown in words.
[[noreturn]] void throw_unreadable(const std::string& reason, const std::string& subject) {
  if (reason.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
  throw_input_error("{}: not readable as a mesh: {}", subject, reason);
}

Vec3 vertex_of(const aiMesh& mesh, const aiFace& face, unsigned corner, const std::string& subject) {
  const unsigned index = face.mIndices[corner];
  if (index >= mesh.mNumVertices)
    throw_input_error("{}: a triangle names a vertex that is not there", subject);
  const aiVector3D& v = mesh.mVertices[index];
  if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
    throw_input_error("{}: a vertex is not finite", subject);
  return {v.x, v.y, v.z};
}

/// What the child does.
std::vector<Vec3> import_triangles(std::string_view bytes, const std::string& format,
                                   const std::string& subject, std::size_t most_triangles) {
  Assimp::Importer importer;
  keep_readers_of(format, importer);
  importer.SetIOHandler(new NoFiles);  // which the importer then owns
  const aiScene* scene = importer.ReadFileFromMemory(
      bytes.data(), bytes.size(), aiProcess_Triangulate | aiProcess_PreTransformVertices, format.c_str());
  if (!scene) throw_unreadable(importer.GetErrorString(), subject);
  std::vector<Vec3> triangles;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;  // points and lines
      if (triangles.size() / 3 >= most_triangles)
        throw_input_error("{}: got more than {} triangles, expected fewer", subject, most_triangles);
      for (unsigned corner = 0; corner < 3; ++corner)
        triangles.push_back(vertex_of(mesh, face, corner, subject));
    }
  }
  return triangles;
}

}  // namespace

std::vector<Vec3> read_mesh_triangles(std::string_view bytes, const std::string& format,
                                      const std::string& subject, std::size_t most_triangles) {
  try {
    check_ply_head(bytes);
  } catch (const InputError& error) {
    throw_input_error("{}: {}", subject, error.what());
  }
  Child child(subject + ": not readable as a mesh", limits_for(bytes.size()), [&](const SendBytes& send) {
    const std::vector<Vec3> triangles = import_triangles(bytes, format, subject, most_triangles);
    const std::uint64_t vertices = triangles.size();
    send(&vertices, sizeof vertices);
    send(triangles.data(), vertices * sizeof(Vec3));
  });
  std::uint64_t vertices = 0;
  child.read(&vertices, sizeof vertices);
  if (vertices > 3 * most_triangles || vertices % 3 != 0)
    throw_input_error("{}: not readable as a mesh: its reader sent {} vertices", subject, vertices);
  std::vector<Vec3> triangles(vertices);
  child.read(triangles.data(), vertices * sizeof(Vec3));
  child.finish();
  if (!std::all_of(triangles.begin(), triangles.end(), [](const Vec3& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
      }))
    throw_input_error("{}: a vertex is not finite", subject);
  return triangles;
}

}  // namespace espalier
