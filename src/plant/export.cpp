// Export through Assimp: our arrays become its scene, its exporter makes the files in memory, and they
// are written whole. Metres; y up for glTF (Khronos, glTF 2.0, section 3.4), z up otherwise.
#include "plant/export.h"

#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Exporter.hpp>
#include <cctype>
#include <memory>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/files.h"

namespace espalier {

namespace {

namespace fs = std::filesystem;

struct MeshFormat {
  std::string_view extension, assimp_id;
  bool y_up, vertex_colours;
};

constexpr std::array<MeshFormat, 4> kFormats{{{".glb", "glb2", true, false},
                                              {".obj", "obj", false, false},
                                              {".ply", "plyb", false, true},
                                              {".stl", "stlb", false, false}}};

struct Material {
  const char* name;
  aiColor3D colour;
  bool two_sided;
};

const Material kBark{"bark", {0.36f, 0.28f, 0.21f}, false};
const Material kLeaf{"leaf", {0.22f, 0.40f, 0.10f}, true};
const Material kBlossom{"blossom", {0.95f, 0.80f, 0.84f}, true};

const MeshFormat& format_of(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const MeshFormat& format : kFormats)
    if (format.extension == extension) return format;
  throw_input_error("mesh '{}': unknown extension '{}', expected .glb, .obj, .ply or .stl", path.string(),
                    path.extension().string());
}

aiVector3D to_assimp(Vec3 v, bool y_up) {
  return y_up ? aiVector3D(v.x, v.z, -v.y) : aiVector3D(v.x, v.y, v.z);
}

void copy_vertices(const TriangleMesh& mesh, bool y_up, aiMesh& out) {
  out.mNumVertices = static_cast<unsigned>(mesh.position_m.size());
  out.mVertices = new aiVector3D[out.mNumVertices];
  out.mNormals = new aiVector3D[out.mNumVertices];
  out.mTextureCoords[0] = new aiVector3D[out.mNumVertices];
  out.mNumUVComponents[0] = 2;
  for (unsigned i = 0; i < out.mNumVertices; ++i) {
    out.mVertices[i] = to_assimp(mesh.position_m[i], y_up);
    out.mNormals[i] = to_assimp(mesh.normal[i], y_up);
    out.mTextureCoords[0][i] = aiVector3D(mesh.texture[i].u, mesh.texture[i].v, 0);
  }
}

/// Assimp declares its glTF to have FB_ngon_encoding: neighbours with the same first corner are parts of one
/// polygon. Ours are triangles, so no two neighbours may start with the same one.
void copy_faces(const TriangleMesh& mesh, aiMesh& out) {
  out.mNumFaces = static_cast<unsigned>(mesh.triangles.size());
  out.mFaces = new aiFace[out.mNumFaces];
  out.mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  for (unsigned f = 0; f < out.mNumFaces; ++f) {
    const auto& t = mesh.triangles[f];
    const bool turn = f > 0 && out.mFaces[f - 1].mIndices[0] == t[0];
    out.mFaces[f].mNumIndices = 3;
    out.mFaces[f].mIndices = turn ? new unsigned[3]{t[1], t[2], t[0]} : new unsigned[3]{t[0], t[1], t[2]};
  }
}

void colour_vertices(aiColor3D colour, aiMesh& out) {
  out.mColors[0] = new aiColor4D[out.mNumVertices];
  std::fill_n(out.mColors[0], out.mNumVertices, aiColor4D(colour.r, colour.g, colour.b, 1));
}

std::unique_ptr<aiMaterial> to_assimp(const Material& material) {
  auto out = std::make_unique<aiMaterial>();
  const aiString name(material.name);
  const aiColor4D base_colour(material.colour.r, material.colour.g, material.colour.b, 1);
  const float metallic = 0, roughness = 0.8f;
  const int two_sided = material.two_sided ? 1 : 0;
  out->AddProperty(&name, AI_MATKEY_NAME);
  out->AddProperty(&material.colour, 1, AI_MATKEY_COLOR_DIFFUSE);
  out->AddProperty(&base_colour, 1, AI_MATKEY_BASE_COLOR);
  out->AddProperty(&metallic, 1, AI_MATKEY_METALLIC_FACTOR);
  out->AddProperty(&roughness, 1, AI_MATKEY_ROUGHNESS_FACTOR);
  out->AddProperty(&two_sided, 1, AI_MATKEY_TWOSIDED);
  return out;
}

/// A scene with as many children of its root as there can be meshes. It owns what is put into it.
std::unique_ptr<aiScene> empty_scene(unsigned capacity) {
  auto scene = std::make_unique<aiScene>();
  scene->mMeshes = new aiMesh* [capacity] {};
  scene->mMaterials = new aiMaterial* [capacity] {};
  scene->mRootNode = new aiNode("plant");
  scene->mRootNode->mChildren = new aiNode* [capacity] {};
  return scene;
}

void add_mesh(const TriangleMesh& mesh, const Material& material, const MeshFormat& format, aiScene& scene) {
  if (mesh.triangles.empty()) return;
  const unsigned index = scene.mNumMeshes;
  aiMesh* out = scene.mMeshes[scene.mNumMeshes++] = new aiMesh;
  out->mName = aiString(material.name);
  out->mMaterialIndex = index;
  copy_vertices(mesh, format.y_up, *out);
  copy_faces(mesh, *out);
  if (format.vertex_colours) colour_vertices(material.colour, *out);
  scene.mMaterials[scene.mNumMaterials++] = to_assimp(material).release();
  aiNode& root = *scene.mRootNode;
  aiNode* node = root.mChildren[root.mNumChildren++] = new aiNode(material.name);
  node->mParent = &root;
  node->mNumMeshes = 1;
  node->mMeshes = new unsigned[1]{index};
}

std::unique_ptr<aiScene> make_scene(const PlantMesh& mesh, const MeshFormat& format) {
  std::unique_ptr<aiScene> scene = empty_scene(3);
  add_mesh(mesh.bark, kBark, format, *scene);
  add_mesh(mesh.leaves, kLeaf, format, *scene);
  add_mesh(mesh.blossoms, kBlossom, format, *scene);
  return scene;
}

std::string_view bytes_of(const aiExportDataBlob& blob) {
  return {static_cast<const char*>(blob.data), blob.size};
}

}  // namespace

void check_mesh_path(const fs::path& path) {
  format_of(path);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder))
    throw_input_error("mesh '{}': no folder '{}'", path.string(), folder.string());
  if (fs::is_directory(path)) throw_input_error("mesh '{}': is a folder, expected a file", path.string());
}

void write_mesh(const PlantMesh& mesh, const fs::path& path) {
  check_mesh_path(path);
  const MeshFormat& format = format_of(path);
  if (mesh.triangle_count() == 0)
    throw_input_error("mesh '{}': the plant has no stems and no leaves", path.string());
  Assimp::Exporter exporter;
  Assimp::ExportProperties properties;
  properties.SetPropertyString(AI_CONFIG_EXPORT_BLOB_NAME, path.filename().string());  // an obj names its mtl
  const std::unique_ptr<aiScene> scene = make_scene(mesh, format);
  const aiExportDataBlob* blob =
      exporter.ExportToBlob(scene.get(), std::string(format.assimp_id), 0, &properties);
  if (!blob)
    throw InternalError(fmt::format("mesh '{}': Assimp: {}", path.string(), exporter.GetErrorString()));
  // The first blob is the mesh, one may follow. The mesh is written last: it names the other.
  for (const aiExportDataBlob* extra = blob->next; extra; extra = extra->next)
    write_file_atomically(path.parent_path() / extra->name.C_Str(), bytes_of(*extra));
  write_file_atomically(path, bytes_of(*blob));
}

void export_mesh(const Plant& plant, const fs::path& path, const MeshOptions& options) {
  check_mesh_path(path);
  write_mesh(mesh_plant(plant, options), path);
}

}  // namespace espalier
