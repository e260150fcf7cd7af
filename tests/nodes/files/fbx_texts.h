// A small FBX for tests.
#pragma once
#include <string>

namespace kinegraph {

// Hips, Leg and Foot at 30 frames a second. Hips: turned by 90° about Z beforehand. Leg: turns by 0, 45 and
// 90° about Z, behind 30° about X, round a pivot 5 above it.
inline std::string text_fbx(int up, int front, int front_sign, double unit) {
  auto limb = [](const char* id, const char* name, const char* more) {
    return std::string("Model: ") + id + ", \"Model::" + name +
           "\", \"LimbNode\" {\nVersion: 232\nProperties70:  {\n"
           "P: \"RotationActive\", \"bool\", \"\", \"\",1\nP: \"InheritType\", \"enum\", \"\", \"\",1\n" +
           more + "}\nShading: T\nCulling: \"CullingOff\"\n}\n";
  };
  auto curve = [](const char* id, const char* values) {
    return std::string("AnimationCurve: ") + id +
           ", \"AnimCurve::\", \"\" {\nDefault: 0\nKeyVer: 4009\nKeyTime: *3 {\na: "
           "0,1539538600,3079077200\n}\n"
           "KeyValueFloat: *3 {\na: " +
           values +
           "\n}\nKeyAttrFlags: *1 {\na: 24840\n}\nKeyAttrDataFloat: *4 {\na: 0,0,255790911,0\n}\n"
           "KeyAttrRefCount: *1 {\na: 3\n}\n}\n";
  };
  auto setting = [](const char* name, int value) {
    return std::string("P: \"") + name + "\", \"int\", \"Integer\", \"\"," + std::to_string(value) + "\n";
  };
  return "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\nFBXHeaderVersion: 1003\nFBXVersion: 7400\n}\n"
         "GlobalSettings:  {\nVersion: 1000\nProperties70:  {\n" +
         setting("UpAxis", up) + setting("UpAxisSign", 1) + setting("FrontAxis", front) +
         setting("FrontAxisSign", front_sign) + setting("CoordAxis", 0) + setting("CoordAxisSign", 1) +
         "P: \"UnitScaleFactor\", \"double\", \"Number\", \"\"," + std::to_string(unit) +
         "\nP: \"TimeMode\", \"enum\", \"\", \"\",6\n}\n}\nObjects:  {\n" +
         limb("1", "Hips",
              "P: \"PreRotation\", \"Vector3D\", \"Vector\", \"\",0,0,90\n"
              "P: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\",10,100,5\n") +
         limb("2", "Leg",
              "P: \"RotationPivot\", \"Vector3D\", \"Vector\", \"\",0,5,0\n"
              "P: \"PreRotation\", \"Vector3D\", \"Vector\", \"\",30,0,0\n"
              "P: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\",0,-40,0\n") +
         limb("3", "Foot", "P: \"Lcl Translation\", \"Lcl Translation\", \"\", \"A\",0,-35,0\n") +
         "AnimationStack: 10, \"AnimStack::Swing\", \"\" {\n}\nAnimationLayer: 11, \"AnimLayer::Base\", \"\" "
         "{\n}\n"
         "AnimationCurveNode: 12, \"AnimCurveNode::R\", \"\" {\nProperties70:  {\n"
         "P: \"d|X\", \"Number\", \"\", \"A\",0\nP: \"d|Y\", \"Number\", \"\", \"A\",0\n"
         "P: \"d|Z\", \"Number\", \"\", \"A\",0\n}\n}\n" +
         curve("13", "0,0,0") + curve("14", "0,0,0") + curve("15", "0,45,90") +
         "}\nConnections:  {\nC: \"OO\",1,0\nC: \"OO\",2,1\nC: \"OO\",3,2\nC: \"OO\",11,10\nC: \"OO\",12,11\n"
         "C: \"OP\",12,2, \"Lcl Rotation\"\nC: \"OP\",13,12, \"d|X\"\nC: \"OP\",14,12, \"d|Y\"\n"
         "C: \"OP\",15,12, \"d|Z\"\n}\n";
}

}  // namespace kinegraph
