#include "nodes/motion/joint_names.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <utility>

namespace kinegraph {

namespace {

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_upper(char c) {
  return std::isupper(static_cast<unsigned char>(c)) != 0;
}
bool is_lower(char c) {
  return std::islower(static_cast<unsigned char>(c)) != 0;
}
bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}
char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

std::string_view without_number(std::string_view word) {
  while (!word.empty() && is_digit(word.back())) word.remove_suffix(1);
  return word;
}

BodyPart limb_part(std::string_view word) {
  word = without_number(word);
  if (is_one_of(word, {"upleg", "upperleg", "thigh", "femur", "hip"})) return BodyPart::thigh;
  if (is_one_of(word, {"leg", "lowleg", "lowerleg", "loleg", "shin", "tibia", "calf", "knee"}))
    return BodyPart::shin;
  if (is_one_of(word, {"foot", "ankle"})) return BodyPart::foot;
  if (is_one_of(word, {"toe", "toes", "toebase", "ball", "forefoot"})) return BodyPart::toe;
  if (is_one_of(word, {"clavicle", "collar", "collarbone"})) return BodyPart::clavicle;
  if (word == "shoulder") return BodyPart::shoulder;
  if (is_one_of(word, {"arm", "upperarm", "uparm", "humerus", "shldr"})) return BodyPart::upper_arm;
  if (is_one_of(word, {"forearm", "lowerarm", "lowarm", "loarm", "radius", "elbow"}))
    return BodyPart::forearm;
  if (word == "wrist") return BodyPart::wrist;
  if (word == "hand") return BodyPart::hand;
  return BodyPart::none;
}

BodyPart middle_part(std::string_view word) {
  word = without_number(word);
  if (is_one_of(word, {"hips", "hip", "pelvis"})) return BodyPart::pelvis;
  if (is_one_of(word, {"spine", "chest", "upperchest", "thorax", "abdomen", "torso", "waist", "lowerback",
                       "upperback"}))
    return BodyPart::spine;
  if (is_one_of(word, {"neck", "lowerneck", "upperneck"})) return BodyPart::neck;
  if (word == "head") return BodyPart::head;
  return BodyPart::none;
}

bool stands_beside(std::string_view word) {
  return limb_part(word) != BodyPart::none ||
         is_one_of(without_number(word), {"thumb", "finger", "fingers", "index", "mid", "middle", "ring",
                                          "pinky", "hipjoint", "eye"});
}

// "lThumb", "LHipJoint", "UpperArmR": a letter that capitals set apart.
Side side_letter_of(std::string_view token, std::size_t& at) {
  const auto side = [](char c) { return lower(c) == 'l' ? Side::left : Side::right; };
  const auto is_letter = [](char c) { return lower(c) == 'l' || lower(c) == 'r'; };
  if (token.size() > 2 && is_letter(token[0]) && is_upper(token[1]) && is_lower(token[2])) {
    at = 0;
    return side(token[0]);
  }
  const char last = token.back();
  if (token.size() > 2 && (last == 'L' || last == 'R') && is_lower(token[token.size() - 2])) {
    at = token.size() - 1;
    return side(last);
  }
  return Side::middle;
}

}  // namespace

JointName read_joint_name(std::string_view name) {
  if (auto colon = name.rfind(':'); colon != name.npos) name.remove_prefix(colon + 1);
  JointName out;
  for (std::size_t i = 0; i < name.size();) {
    if (!std::isalnum(static_cast<unsigned char>(name[i]))) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < name.size() && std::isalnum(static_cast<unsigned char>(name[end]))) ++end;
    std::string token(name.substr(i, end - i));
    i = end;
    if (token.size() == 1 && is_one_of(token, {"l", "r", "L", "R"})) {
      out.side = lower(token[0]) == 'l' ? Side::left : Side::right;
      continue;
    }
    std::size_t at = 0;
    if (const Side side = side_letter_of(token, at); side != Side::middle) {
      out.side = side;
      token.erase(at, 1);
    }
    std::transform(token.begin(), token.end(), token.begin(), lower);
    if (is_one_of(token, {"cc", "base", "bip", "bip01", "bip001", "def", "jnt", "joint", "mixamorig"}))
      continue;
    out.word += token;
  }
  if (constexpr std::string_view rig = "mixamorig"; out.word.starts_with(rig))  // mixamorig9Hips, too
    out.word.erase(0, std::min(out.word.find_first_not_of("0123456789", rig.size()), out.word.size()));
  for (auto [long_name, its_side] : {std::pair{"left", Side::left}, std::pair{"right", Side::right}}) {
    if (auto at = out.word.find(long_name); at != out.word.npos) {
      out.side = its_side;
      out.word.erase(at, std::string_view(long_name).size());
    }
  }
  // A lone l or r in front: only where what is left stands beside the middle, as in lfemur.
  const bool at_front = !out.word.empty() && (out.word.front() == 'l' || out.word.front() == 'r');
  if (out.side == Side::middle && at_front && stands_beside(out.word.substr(1)) && !stands_beside(out.word) &&
      middle_part(out.word) == BodyPart::none) {
    out.side = out.word.front() == 'l' ? Side::left : Side::right;
    out.word.erase(0, 1);
  }
  out.part = out.side == Side::middle ? middle_part(out.word) : limb_part(out.word);
  return out;
}

}  // namespace kinegraph
