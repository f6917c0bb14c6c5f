// Export through Assimp: our arrays become its scene, its exporter makes the files in memory, and they
// are written whole. Metres; y up for glTF (Khronos, glTF 2.0, section 3.4).
#include <assimp/material.h>
#include <assimp/scene.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <assimp/Exporter.hpp>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <espalier/core/error.h>
#include <espalier/core/field_error.h>
#include <espalier/core/files.h>
#include <espalier/plant/export.h>
#include <espalier/plant/mesh_colors.h>

namespace espalier {

namespace {

namespace fs = std::filesystem;

struct MeshFormat {
  std::string_view extension, assimp_id;
  bool y_up;
};

constexpr std::array<MeshFormat, 4> kFormats{
    {{".glb", "glb2", true}, {".obj", "obj", true}, {".ply", "plyb", false}, {".stl", "stlb", false}}};

struct Material {
  std::string name;
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

/// glTF's colours are linear, and so are ours of bark and leaves (IEC 61966-2-1).
float linear(std::uint8_t srgb) {
  const float c = static_cast<float>(srgb) / 255;
  return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

/// "bark" with a colour is "bark_a0522d".
Material colored(const Material& material, PartColor color) {
  if (!color.is_set) return material;
  return {fmt::format("{}_{:02x}{:02x}{:02x}", material.name, color.r, color.g, color.b),
          {linear(color.r), linear(color.g), linear(color.b)},
          material.two_sided};
}

aiVector3D to_assimp(Vec3 v, bool y_up) {
  return y_up ? aiVector3D(v.x, v.z, -v.y) : aiVector3D(v.x, v.y, v.z);
}

/// A run of triangles and the run of vertices that they and no others use.
struct Piece {
  std::size_t first_triangle = 0, triangle_end = 0;
  std::uint32_t first_vertex = 0, vertex_end = 0;
};

/// Cuts a mesh between its tubes and leaves. Assimp's export needs hundreds of bytes a vertex for one mesh at
/// a time, so pieces keep the memory for large trees down.
std::vector<Piece> cut_into_pieces(const TriangleMesh& mesh) {
  constexpr std::uint32_t kPieceVertices = 1u << 18;
  std::vector<Piece> pieces;
  Piece piece;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto [lowest, highest] = std::minmax_element(mesh.triangles[f].begin(), mesh.triangles[f].end());
    if (*lowest >= piece.vertex_end && piece.vertex_end - piece.first_vertex >= kPieceVertices) {
      pieces.push_back(piece);
      piece = {f, f, piece.vertex_end, piece.vertex_end};
    }
    piece.triangle_end = f + 1;
    piece.vertex_end = std::max(piece.vertex_end, *highest + 1);
  }
  if (piece.triangle_end > piece.first_triangle) pieces.push_back(piece);
  return pieces;
}

void copy_vertices(const TriangleMesh& mesh, const Piece& piece, bool y_up, aiMesh& out) {
  out.mNumVertices = piece.vertex_end - piece.first_vertex;
  out.mVertices = new aiVector3D[out.mNumVertices];
  out.mNormals = new aiVector3D[out.mNumVertices];
  out.mTextureCoords[0] = new aiVector3D[out.mNumVertices];
  out.mNumUVComponents[0] = 2;
  for (unsigned i = 0; i < out.mNumVertices; ++i) {
    const std::size_t from = piece.first_vertex + i;
    out.mVertices[i] = to_assimp(mesh.position_m[from], y_up);
    out.mNormals[i] = to_assimp(mesh.normal[from], y_up);
    out.mTextureCoords[0][i] = aiVector3D(mesh.texture[from].u, mesh.texture[from].v, 0);
  }
}

/// Assimp declares its glTF to have FB_ngon_encoding: neighbours with the same first corner are parts of one
/// polygon. Ours are triangles, so no two neighbours may start with the same one.
void copy_faces(const TriangleMesh& mesh, const Piece& piece, aiMesh& out) {
  out.mNumFaces = static_cast<unsigned>(piece.triangle_end - piece.first_triangle);
  out.mFaces = new aiFace[out.mNumFaces];
  out.mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  for (unsigned f = 0; f < out.mNumFaces; ++f) {
    std::array<std::uint32_t, 3> t = mesh.triangles[piece.first_triangle + f];
    for (std::uint32_t& vertex : t) vertex -= piece.first_vertex;
    if (f > 0 && out.mFaces[f - 1].mIndices[0] == t[0]) std::rotate(t.begin(), t.begin() + 1, t.end());
    out.mFaces[f].mNumIndices = 3;
    out.mFaces[f].mIndices = new unsigned[3]{t[0], t[1], t[2]};
  }
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

aiMesh* to_assimp(const TriangleMesh& mesh, const Piece& piece, const Material& material,
                  const MeshFormat& format) {
  auto out = std::make_unique<aiMesh>();
  out->mName = aiString(material.name);
  copy_vertices(mesh, piece, format.y_up, *out);
  copy_faces(mesh, piece, *out);
  return out.release();
}

/// What shares a material. Parts with colours of their own are copies.
struct Part {
  std::shared_ptr<const TriangleMesh> mesh;
  Material material;
  std::vector<Piece> pieces;
};

void add_parts(const TriangleMesh& mesh, const Material& material, std::vector<Part>& parts) {
  const auto add = [&](std::shared_ptr<const TriangleMesh> of, const Material& its) {
    std::vector<Piece> pieces = cut_into_pieces(*of);
    if (!pieces.empty()) parts.push_back({std::move(of), its, std::move(pieces)});
  };
  if (mesh.color.empty()) return add({std::shared_ptr<void>(), &mesh}, material);
  for (auto& [color, part] : split_by_color(mesh))
    add(std::make_shared<TriangleMesh>(std::move(part)), colored(material, color));
}

/// The material in the colour of a species; its name stays.
Material in_color(Material material, PartColor color) {
  if (color.is_set) material.colour = {linear(color.r), linear(color.g), linear(color.b)};
  return material;
}

std::vector<Part> parts_of(const PlantMesh& mesh, const MeshFileOptions& options) {
  std::vector<Part> parts;
  add_parts(mesh.bark, in_color(kBark, options.bark), parts);
  add_parts(mesh.leaves, in_color(kLeaf, options.leaf), parts);
  add_parts(mesh.blossoms, kBlossom, parts);
  return parts;
}

/// Adds one material and one node, with a mesh a piece.
void add_part(const Part& part, const MeshFormat& format, aiScene& scene) {
  aiNode& root = *scene.mRootNode;
  aiNode* node = root.mChildren[root.mNumChildren++] = new aiNode(part.material.name);
  node->mParent = &root;
  node->mMeshes = new unsigned[part.pieces.size()];
  for (const Piece& piece : part.pieces) {
    aiMesh* mesh = scene.mMeshes[scene.mNumMeshes] = to_assimp(*part.mesh, piece, part.material, format);
    mesh->mMaterialIndex = scene.mNumMaterials;
    node->mMeshes[node->mNumMeshes++] = scene.mNumMeshes++;
  }
  scene.mMaterials[scene.mNumMaterials++] = to_assimp(part.material).release();
}

/// One child of the root a material. The scene owns what is in it.
std::unique_ptr<aiScene> make_scene(const PlantMesh& mesh, const MeshFormat& format,
                                    const MeshFileOptions& options) {
  const std::vector<Part> parts = parts_of(mesh, options);
  std::size_t piece_count = 0;
  for (const Part& part : parts) piece_count += part.pieces.size();
  auto scene = std::make_unique<aiScene>();
  scene->mMeshes = new aiMesh* [piece_count] {};
  scene->mMaterials = new aiMaterial* [parts.size()] {};
  scene->mRootNode = new aiNode("plant");
  scene->mRootNode->mChildren = new aiNode* [parts.size()] {};
  for (const Part& part : parts) add_part(part, format, *scene);
  return scene;
}

std::string_view bytes_of(const aiExportDataBlob& blob) {
  return {static_cast<const char*>(blob.data), blob.size};
}

/// The row of the format with the axis that was asked for.
MeshFormat format_for(const fs::path& path, const MeshFileOptions& options) {
  MeshFormat format = format_of(path);
  if (options.up) format.y_up = *options.up == UpAxis::y;
  if (format.extension == ".glb" && !format.y_up)
    throw_field_error("up", "got z for '{}', expected y, which glTF demands, or an obj, ply or stl",
                      path.string());
  return format;
}

/// A name that every reader of obj takes for one word.
std::string safe_name(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) &&
        std::string_view(".-_").find(c) == std::string_view::npos)
      c = '_';
  return name;
}

std::string axes_in_words(const MeshFormat& format) {
  return format.y_up ? "metres, y is up, the front is seen from +z"
                     : "metres, z is up, the front is seen from -y";
}

/// The bytes of a file with what they are in its header, where the format has room for words.
std::string with_header(const MeshFormat& format, std::string_view bytes) {
  const std::string words = "Espalier: " + axes_in_words(format);
  std::string file(bytes);
  if (format.extension == ".obj") return "# " + words + "\n" + file;
  if (format.extension == ".ply") {
    const auto behind_format = file.find('\n', file.find("\nformat ") + 1) + 1;
    return file.insert(behind_format, "comment " + words + "\n");
  }
  constexpr std::size_t kStlHeader = 80;
  if (format.extension == ".stl")
    file.replace(0, kStlHeader, (words + std::string(kStlHeader, ' ')).substr(0, kStlHeader));
  return file;
}

/// Assimp gives no reason where memory has no room for the file.
[[noreturn]] void throw_not_written(const PlantMesh& mesh, const fs::path& path, std::string_view reason) {
  if (reason.empty())
    throw_input_error("mesh '{}': its {} triangles need more memory than there is", path.string(),
                      mesh.triangle_count());
  throw InternalError(fmt::format("mesh '{}': Assimp: {}", path.string(), reason));
}

}  // namespace

void check_mesh_path(const fs::path& path) {
  format_of(path);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code none;
  if (!fs::is_directory(folder, none))
    throw_input_error("mesh '{}': no folder '{}'", path.string(), folder.string());
  if (fs::is_directory(path, none))
    throw_input_error("mesh '{}': is a folder, expected a file", path.string());
  if (access(folder.c_str(), W_OK) != 0)
    throw_input_error("mesh '{}': folder '{}' cannot be written: {}", path.string(), folder.string(),
                      std::strerror(errno));
}

UpAxis usual_up_axis(const fs::path& path) { return format_of(path).y_up ? UpAxis::y : UpAxis::z; }

void check_up_axis(const fs::path& path, UpAxis up) { format_for(path, {.up = up}); }

void write_mesh(const PlantMesh& mesh, const fs::path& path, const MeshFileOptions& options) {
  check_mesh_path(path);
  const MeshFormat format = format_for(path, options);
  if (mesh.triangle_count() == 0)
    throw_input_error("mesh '{}': the plant has no stems and no leaves", path.string());
  if (mesh.triangle_count() > options.most_triangles)
    throw_input_error("mesh '{}': the plant has {} triangles, expected at most {}: a lower detail has fewer",
                      path.string(), mesh.triangle_count(), options.most_triangles);
  Assimp::Exporter exporter;
  Assimp::ExportProperties properties;
  properties.SetPropertyString(AI_CONFIG_EXPORT_BLOB_NAME, safe_name(path.filename().string()));  // of an mtl
  const std::unique_ptr<aiScene> scene = make_scene(mesh, format, options);
  const aiExportDataBlob* blob =
      exporter.ExportToBlob(scene.get(), std::string(format.assimp_id), 0, &properties);
  if (!blob) throw_not_written(mesh, path, exporter.GetErrorString());
  // The first blob is the mesh, one may follow. The mesh is written last: it names the other.
  for (const aiExportDataBlob* extra = blob->next; extra; extra = extra->next)
    write_file_atomically(path.parent_path() / extra->name.C_Str(), bytes_of(*extra));
  write_file_atomically(path, with_header(format, bytes_of(*blob)));
}

void export_mesh(const Plant& plant, const fs::path& path, const MeshOptions& options) {
  check_mesh_path(path);
  write_mesh(mesh_plant(plant, options), path);
}

}  // namespace espalier
