// Character in the disk cache.
#include "nodes/motion/character.h"
#include "nodes/motion/codec.h"

namespace kinegraph {

namespace {

void put(Encoder& out, const Affine& a) {
  for (const auto& row : a.rows)
    for (double value : row) out.f64(value);
}
Affine decode_affine(Decoder& in) {
  Affine a;
  for (auto& row : a.rows)
    for (double& value : row) value = in.f64();
  return a;
}

void encode_whole(Encoder& out, const std::vector<int>& all) {
  encode_list(out, all, [&](int one) { out.i64(one); });
}
int decode_whole(Decoder& in) {
  return static_cast<int>(in.i64());
}
std::vector<int> decode_wholes(Decoder& in) {
  return decode_list<int>(in, [&] { return decode_whole(in); });
}

void put(Encoder& out, const MeshPart& part) {
  out.text(part.name);
  out.f32s(part.positions);
  out.f32s(part.normals);
  out.f32s(part.texcoords);
  out.u32s(part.triangles);
  out.i64(part.skin);
  out.i64(part.influences);
  out.u32s(part.joints);
  out.f32s(part.weights);
  out.i64(part.joint);
  put(out, part.placed);
  encode_list(out, part.morphs, [&](const MorphTarget& morph) {
    out.text(morph.name);
    out.f32s(morph.positions);
    out.f32s(morph.normals);
  });
  out.i64(part.source_mesh);
  out.i64(part.source_primitive);
  out.i64(part.source_node);
}

MeshPart decode_part(Decoder& in) {
  MeshPart part;
  part.name = in.text();
  part.positions = in.f32s();
  part.normals = in.f32s();
  part.texcoords = in.f32s();
  part.triangles = in.u32s();
  part.skin = decode_whole(in);
  part.influences = decode_whole(in);
  part.joints = in.u32s();
  part.weights = in.f32s();
  part.joint = decode_whole(in);
  part.placed = decode_affine(in);
  part.morphs = decode_list<MorphTarget>(in, [&] {
    MorphTarget morph;
    morph.name = in.text();
    morph.positions = in.f32s();
    morph.normals = in.f32s();
    return morph;
  });
  part.source_mesh = decode_whole(in);
  part.source_primitive = decode_whole(in);
  part.source_node = decode_whole(in);
  return part;
}

void check(const MeshPart& part, const Character& character) {
  const std::size_t vertices = part.vertices();
  if (part.positions.size() % 3 || (!part.normals.empty() && part.normals.size() != 3 * vertices) ||
      (!part.texcoords.empty() && part.texcoords.size() != 2 * vertices) || part.triangles.size() % 3)
    damaged("a mesh has lists of other lengths than its vertices");
  for (std::uint32_t vertex : part.triangles)
    if (vertex >= vertices) damaged("a triangle has no such vertex");
  if (part.skin >= static_cast<int>(character.skins.size()) || part.joint >= character.skeleton->size())
    damaged("a mesh hangs on nothing");
  for (const MorphTarget& morph : part.morphs)
    if (morph.positions.size() != 3 * vertices ||
        (!morph.normals.empty() && morph.normals.size() != 3 * vertices))
      damaged("a morph target has other vertices than its mesh");
  if (part.skin < 0) return;
  if (part.influences < 0 || part.joints.size() != vertices * static_cast<std::size_t>(part.influences) ||
      part.weights.size() != part.joints.size())
    damaged("a mesh has other weights than vertices");
  for (std::uint32_t joint : part.joints)
    if (joint >= character.skins[part.skin].joints.size()) damaged("a weight is of no joint");
}

}  // namespace

void Character::encode(Encoder& out) const {
  kinegraph::encode(out, *skeleton);
  encode_list(out, skins, [&](const Skin& skin) {
    out.text(skin.name);
    encode_whole(out, skin.joints);
    for (const Affine& bind : skin.inverse_bind) put(out, bind);
  });
  encode_list(out, parts, [&](const MeshPart& part) { put(out, part); });
  encode_list(out, morph_tracks, [&](const MorphTrack& track) {
    out.i64(track.part);
    out.i64(track.target);
    out.f64s(track.weights);
  });
  out.f64(morph_fps);
  out.f64(unit);
  out.boolean(rebound);
  out.boolean(source != nullptr);
  if (!source) return;
  out.text(source->json);
  encode_list(out, source->buffers, [&](const std::string& buffer) { out.text(buffer); });
  encode_list(out, source->files, [&](const std::pair<std::string, std::string>& file) {
    out.text(file.first);
    out.text(file.second);
  });
  encode_whole(out, source->node_of_joint);
  out.f64s(source->scale_of_parent);
}

ValuePtr decode_character(Decoder& in) {
  auto character = std::make_shared<Character>();
  character->skeleton = std::make_shared<const Skeleton>(decode_skeleton(in));
  const int joints = character->skeleton->size();
  character->skins = decode_list<Skin>(in, [&] {
    Skin skin;
    skin.name = in.text();
    skin.joints = decode_wholes(in);
    for (int joint : skin.joints) {
      if (joint < 0 || joint >= joints) damaged("a skin has no such joint");
      skin.inverse_bind.push_back(decode_affine(in));
    }
    return skin;
  });
  character->parts = decode_list<MeshPart>(in, [&] { return decode_part(in); });
  for (const MeshPart& part : character->parts) check(part, *character);
  character->morph_tracks = decode_list<MorphTrack>(in, [&] {
    MorphTrack track;
    track.part = decode_whole(in);
    track.target = decode_whole(in);
    track.weights = in.f64s();
    if (track.part < 0 || track.part >= static_cast<int>(character->parts.size()) || track.target < 0 ||
        track.target >= static_cast<int>(character->parts[track.part].morphs.size()))
      damaged("a morph track moves no target");
    return track;
  });
  character->morph_fps = in.f64();
  character->unit = in.f64();
  character->rebound = in.boolean();
  if (in.boolean()) {
    auto source = std::make_shared<CharacterSource>();
    source->json = in.text();
    source->buffers = decode_list<std::string>(in, [&] { return in.text(); });
    source->files = decode_list<std::pair<std::string, std::string>>(in, [&] {
      std::string name = in.text();
      return std::pair{std::move(name), in.text()};
    });
    source->node_of_joint = decode_wholes(in);
    source->scale_of_parent = in.f64s();
    if (source->node_of_joint.size() != static_cast<std::size_t>(joints) && !character->rebound)
      damaged("a character's source has other joints");
    character->source = std::move(source);
  }
  return character;
}

}  // namespace kinegraph
