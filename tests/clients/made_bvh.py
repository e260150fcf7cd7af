"""BVH files with what few files have: every order of channels, positions anywhere, odd names, one frame, one joint."""


def chain(offset="0 0 0", root="Xposition Yposition Zposition Zrotation Xrotation Yrotation",
              arm="Zrotation Xrotation Yrotation", names=("Hips", "Arm", "Hand"), frames=5):
    """A chain of three joints that turn far, with the channels asked for."""
    def channels(text):
        return f"CHANNELS {len(text.split())} {text}"
    text = f"""HIERARCHY
ROOT {names[0]}
{{
  OFFSET {offset}
  {channels(root)}
  JOINT {names[1]}
  {{
    OFFSET 3 40 -5
    {channels(arm)}
    JOINT {names[2]}
    {{
      OFFSET -10 35 4
      {channels(arm)}
      End Site
      {{
        OFFSET 0 20 0
      }}
    }}
  }}
}}
MOTION
Frames: {frames}
Frame Time: 0.0333333
"""
    for frame in range(frames):
        values = []
        for joint, order in enumerate((root, arm, arm)):
            for channel, name in enumerate(order.split()):
                turn = (37 * joint + 59 * channel + 31 * frame) % 360 - 180
                values.append(f"{turn if name.endswith('rotation') else 20 + 7 * channel + frame + turn / 90:.6f}")
        text += " ".join(values) + "\n"
    return text


ONE_JOINT = """HIERARCHY
ROOT Ball
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  End Site
  {
    OFFSET 0 30 0
  }
}
MOTION
Frames: 4
Frame Time: 0.0333333
0 10 0 0 0 0
1 11 0 10 170 30
2 12 5 20 -170 60
3 13 6 30 -90 190
"""

SIX = "Xposition Yposition Zposition Yrotation Xrotation Zrotation"
MADE = {
    "order_xyz": chain(arm="Xrotation Yrotation Zrotation"),
    "order_xzy": chain(arm="Xrotation Zrotation Yrotation"),
    "order_yxz": chain(arm="Yrotation Xrotation Zrotation"),
    "order_yzx": chain(arm="Yrotation Zrotation Xrotation"),
    "order_zyx": chain(arm="Zrotation Yrotation Xrotation"),
    "positions_between_rotations": chain(
        root="Yrotation Xposition Xrotation Zposition Zrotation Yposition"),
    "positions_everywhere": chain(arm=SIX),
    "positions_in_odd_order": chain(arm="Zposition Xposition Yposition Xrotation Zrotation Yrotation"),
    "one_frame": chain(frames=1),
    "one_joint": ONE_JOINT,
    "root_offset": chain(offset="11 95 -7"),
    "japanese_names": chain(names=("腰", "左腕", "左手首")),
    "names_with_spaces": chain(names=("Hips of it", "Left Arm", "Lower Hand 2")),
}
