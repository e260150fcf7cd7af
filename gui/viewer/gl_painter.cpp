#include "gui/viewer/gl_painter.h"

#include <QOpenGLBuffer>
#include <QOpenGLContext>
#include <QOpenGLExtraFunctions>
#include <QOpenGLFramebufferObject>
#include <QOpenGLShaderProgram>
#include <QOpenGLVertexArrayObject>
#include <QVector2D>
#include <cmath>
#include <stdexcept>

#include "gui/viewer/flat_shapes.h"

#ifndef GL_BGRA
#define GL_BGRA 0x80E1
#endif
#ifndef GL_UNSIGNED_INT_8_8_8_8_REV
#define GL_UNSIGNED_INT_8_8_8_8_REV 0x8367
#endif

namespace kinegraph {
namespace {

// Corners of a capsule's section and rings of each of its ends: few while it plays, round when it rests.
struct CapsuleDetail {
  int around, rings;
};
constexpr CapsuleDetail coarse{12, 4}, fine{32, 9};
constexpr int samples = 4;  // of a picture that rests

// A point of the unit capsule is a direction from one of its two ends.
const char* const capsule_vertices = R"(
layout(location = 0) in vec3 direction;
layout(location = 1) in float end;
layout(location = 2) in vec4 a;
layout(location = 3) in vec4 b;
layout(location = 4) in vec4 color;
uniform mat4 world_to_picture;
uniform vec3 light;
uniform float flat_at;
uniform bool flattened;
out vec3 normal;
out vec4 base;
out vec3 at;
void main() {
  vec3 axis = b.xyz - a.xyz;
  float length_of_axis = length(axis);
  axis = length_of_axis > 1e-6 ? axis / length_of_axis : vec3(0.0, 1.0, 0.0);
  vec3 u = normalize(cross(axis, abs(axis.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
  vec3 v = cross(axis, u);
  normal = direction.x * u + direction.y * v + direction.z * axis;
  vec3 point = mix(a.xyz, b.xyz, end) + mix(a.w, b.w, end) * normal;
  if (flattened) point -= light * ((point.y - flat_at) / light.y);
  at = point;
  base = color;
  gl_Position = world_to_picture * vec4(point, 1.0);
}
)";
const char* const mesh_vertices = R"(
layout(location = 0) in vec3 point_in;
layout(location = 1) in vec3 normal_in;
uniform mat4 world_to_picture;
uniform vec3 light;
uniform float flat_at;
uniform bool flattened;
uniform vec4 mesh_color;
out vec3 normal;
out vec4 base;
out vec3 at;
void main() {
  vec3 point = point_in;
  if (flattened) point -= light * ((point.y - flat_at) / light.y);
  normal = normal_in;
  at = point;
  base = mesh_color;
  gl_Position = world_to_picture * vec4(point, 1.0);
}
)";
const char* const solid_fragments = R"(
in vec3 normal;
in vec4 base;
in vec3 at;
uniform vec3 light;
uniform vec3 eye;
uniform float opacity;
uniform bool flattened;
uniform vec4 flat_color;
out vec4 picture;
void main() {
  if (flattened) { picture = flat_color; return; }
  vec3 n = normalize(normal);
  vec3 toward = normalize(eye - at);
  if (dot(n, toward) < 0.0) n = -n;
  float key = max(dot(n, light), 0.0);
  float sky = 0.5 + 0.5 * n.y;
  float head = max(dot(n, toward), 0.0);
  float shine = pow(max(dot(n, normalize(light + toward)), 0.0), 24.0);
  vec3 lit = base.rgb * (0.27 + 0.19 * sky + 0.50 * key + 0.18 * head) + vec3(0.10 * shine);
  picture = vec4(lit, opacity);
}
)";
const char* const floor_vertices = R"(
layout(location = 0) in vec2 corner;
uniform mat4 world_to_picture;
uniform vec3 middle;
uniform float reach;
out vec2 at;
void main() {
  vec3 point = middle + vec3(corner.x * reach, 0.0, corner.y * reach);
  at = point.xz;
  gl_Position = world_to_picture * vec4(point, 1.0);
}
)";
const char* const floor_fragments = R"(
in vec2 at;
uniform vec3 middle;
uniform float reach;
uniform float grid;
uniform vec3 ground;
uniform vec3 ground_line;
uniform float fill;
uniform vec2 fades;
uniform float quarters;
out vec4 picture;
float lines(float step, vec2 width) {
  vec2 away = abs(fract(at / step - 0.5) - 0.5) * step;
  vec2 line = 1.0 - clamp(away / width, 0.0, 1.0);
  // Lines nearer together than pixels are a tone, not a pattern.
  line *= clamp(step / (width * 4.0), 0.0, 1.0);
  return max(line.x, line.y);
}
void main() {
  vec2 width = vec2(length(vec2(dFdx(at.x), dFdy(at.x))), length(vec2(dFdx(at.y), dFdy(at.y))));
  float line = max(lines(grid, width), quarters * lines(grid * 0.25, width));
  float fade = 1.0 - smoothstep(fades.x, fades.y, length(at - middle.xz) / reach);
  picture = vec4(mix(ground, ground_line, line), fade * max(fill, line));
}
)";
const char* const flat_vertices = R"(
layout(location = 0) in vec3 point;
layout(location = 1) in vec4 color;
uniform mat4 world_to_picture;
out vec4 base;
void main() {
  base = color;
  gl_Position = world_to_picture * vec4(point, 1.0);
}
)";
const char* const flat_fragments = R"(
in vec4 base;
out vec4 picture;
void main() { picture = base; }
)";

struct CapsulePoint {
  float x, y, z, end;
};
struct CapsuleInstance {
  float a[4], b[4];
  quint8 color[4];
};

void make_capsule(CapsuleDetail detail, std::vector<CapsulePoint>& points, std::vector<quint16>& triangles) {
  const float pi_f = 3.14159265f;
  const int first = static_cast<int>(points.size()), rings = 2 * detail.rings;
  for (int ring = 0; ring < rings; ++ring) {
    const bool upper = ring >= detail.rings;
    // Evenly by angle from each end's pole to its rim.
    const int from_pole = upper ? rings - 1 - ring : ring;
    const float bend = pi_f / 2 * static_cast<float>(from_pole) / static_cast<float>(detail.rings - 1);
    const float z = (upper ? 1.0f : -1.0f) * std::cos(bend), r = std::sin(bend);
    for (int k = 0; k < detail.around; ++k) {
      const float angle = 2 * pi_f * static_cast<float>(k) / static_cast<float>(detail.around);
      points.push_back({r * std::cos(angle), r * std::sin(angle), z, upper ? 1.0f : 0.0f});
    }
  }
  for (int ring = 0; ring + 1 < rings; ++ring)
    for (int k = 0; k < detail.around; ++k) {
      const auto p = [&](int row, int column) {
        return static_cast<quint16>(first + row * detail.around + column % detail.around);
      };
      for (quint16 corner :
           {p(ring, k), p(ring, k + 1), p(ring + 1, k), p(ring + 1, k), p(ring, k + 1), p(ring + 1, k + 1)})
        triangles.push_back(corner);
    }
}

QVector3D rgb_of(QRgb color) {
  return QVector3D(qRed(color), qGreen(color), qBlue(color)) / 255.0f;
}
QVector4D rgba_of(QRgb color) {
  return QVector4D(rgb_of(color), static_cast<float>(qAlpha(color)) / 255.0f);
}

}  // namespace

struct GlPainter::State : QOpenGLExtraFunctions {
  QOpenGLShaderProgram capsule, mesh, floor, flat;
  QOpenGLVertexArrayObject capsule_array, mesh_array, floor_array, flat_array;
  QOpenGLBuffer capsule_points, instances, corners, flats, mesh_points;
  QOpenGLBuffer capsule_triangles{QOpenGLBuffer::IndexBuffer}, mesh_triangles{QOpenGLBuffer::IndexBuffer};
  std::unique_ptr<QOpenGLFramebufferObject> plain, smooth;
  int coarse_corners = 0, fine_corners = 0;
  bool smooth_now = false;
  const QVector3D light = QVector3D(0.45f, 1.0f, 0.35f).normalized();

  State();
  void build(QOpenGLShaderProgram& program, const char* vertices, const char* fragments);
  QOpenGLFramebufferObject& target(QSize size, bool smooth_one);
  void draw_cell(const ScenePicture& picture, const SceneCell& cell);
  void draw_floor(const ScenePicture& picture, const Scene& scene, const OrbitCamera& camera,
                  const QMatrix4x4& m);
  void draw_flats(const std::vector<FlatPoint>& points, const QMatrix4x4& m);
  void draw_figure(const SceneFigure& figure, const Scene& scene, QVector3D eye, const QMatrix4x4& m,
                   bool shadow, QRgb shadow_color);
  template <class Draw>
  void draw_solid(QOpenGLShaderProgram& program, const SceneFigure& figure, const Scene& scene, QVector3D eye,
                  const QMatrix4x4& m, bool shadow, QRgb shadow_color, Draw draw);
};

GlPainter::State::State() {
  initializeOpenGLFunctions();
  build(capsule, capsule_vertices, solid_fragments);
  build(mesh, mesh_vertices, solid_fragments);
  build(floor, floor_vertices, floor_fragments);
  build(flat, flat_vertices, flat_fragments);
  std::vector<CapsulePoint> points;
  std::vector<quint16> triangles;
  make_capsule(coarse, points, triangles);
  coarse_corners = static_cast<int>(triangles.size());
  make_capsule(fine, points, triangles);
  fine_corners = static_cast<int>(triangles.size()) - coarse_corners;

  capsule_array.create();
  capsule_array.bind();
  capsule_points.create();
  capsule_points.bind();
  capsule_points.allocate(points.data(), static_cast<int>(points.size() * sizeof(points[0])));
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(CapsulePoint), nullptr);
  glEnableVertexAttribArray(1);
  glVertexAttribPointer(1, 1, GL_FLOAT, GL_FALSE, sizeof(CapsulePoint), reinterpret_cast<void*>(12));
  capsule_triangles.create();
  capsule_triangles.bind();
  capsule_triangles.allocate(triangles.data(), static_cast<int>(triangles.size() * sizeof(triangles[0])));
  instances.create();
  instances.setUsagePattern(QOpenGLBuffer::StreamDraw);
  instances.bind();
  for (GLuint i = 0; i < 3; ++i) {
    glEnableVertexAttribArray(2 + i);
    glVertexAttribDivisor(2 + i, 1);
  }
  glVertexAttribPointer(2, 4, GL_FLOAT, GL_FALSE, sizeof(CapsuleInstance), nullptr);
  glVertexAttribPointer(3, 4, GL_FLOAT, GL_FALSE, sizeof(CapsuleInstance), reinterpret_cast<void*>(16));
  glVertexAttribPointer(4, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(CapsuleInstance),
                        reinterpret_cast<void*>(32));
  capsule_array.release();

  floor_array.create();
  floor_array.bind();
  corners.create();
  corners.bind();
  const float square[] = {-1, -1, 1, -1, -1, 1, 1, 1};
  corners.allocate(square, sizeof(square));
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 8, nullptr);
  floor_array.release();

  flat_array.create();
  flat_array.bind();
  flats.create();
  flats.setUsagePattern(QOpenGLBuffer::StreamDraw);
  flats.bind();
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(FlatPoint), nullptr);
  glEnableVertexAttribArray(1);
  glVertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(FlatPoint), reinterpret_cast<void*>(12));
  flat_array.release();

  mesh_array.create();
  mesh_points.create();
  mesh_points.setUsagePattern(QOpenGLBuffer::StreamDraw);
  mesh_triangles.create();
  mesh_triangles.setUsagePattern(QOpenGLBuffer::StreamDraw);
}

void GlPainter::State::build(QOpenGLShaderProgram& program, const char* vertices, const char* fragments) {
  const QByteArray head = QOpenGLContext::currentContext()->isOpenGLES()
                              ? "#version 300 es\nprecision highp float;\n"
                              : "#version 330 core\n";
  if (!program.addShaderFromSourceCode(QOpenGLShader::Vertex, head + vertices) ||
      !program.addShaderFromSourceCode(QOpenGLShader::Fragment, head + fragments) || !program.link())
    throw std::runtime_error(program.log().toStdString());
}

QOpenGLFramebufferObject& GlPainter::State::target(QSize size, bool smooth_one) {
  auto& buffer = smooth_one ? smooth : plain;
  if (!buffer || buffer->size() != size) {
    QOpenGLFramebufferObjectFormat format;
    format.setAttachment(QOpenGLFramebufferObject::CombinedDepthStencil);
    if (smooth_one) format.setSamples(samples);
    buffer = std::make_unique<QOpenGLFramebufferObject>(size, format);
    if (!buffer->isValid()) throw std::runtime_error("no framebuffer of this size");
  }
  return *buffer;
}

void GlPainter::State::draw_floor(const ScenePicture& picture, const Scene& scene, const OrbitCamera& camera,
                                  const QMatrix4x4& m) {
  const bool from_below = camera.eye().y() < scene.floor;
  glDepthMask(GL_FALSE);  // a foot that sinks in is seen to, and not cut off
  floor.bind();
  floor.setUniformValue("world_to_picture", m);
  floor.setUniformValue("middle", QVector3D(camera.target.x(), scene.floor, camera.target.z()));
  floor.setUniformValue("reach", floor_reach(camera, scene));
  floor.setUniformValue("grid", scene.grid);
  floor.setUniformValue("fades", QVector2D(floor_fades_from, floor_fades_to));
  floor.setUniformValue("quarters", quarter_lines);
  floor.setUniformValue("ground", rgb_of(picture.colors.ground));
  floor.setUniformValue("ground_line", rgb_of(picture.colors.ground_line));
  floor.setUniformValue("fill", from_below ? 0.0f : 1.0f);
  floor_array.bind();
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  floor_array.release();
  glDepthMask(GL_TRUE);
}

void GlPainter::State::draw_flats(const std::vector<FlatPoint>& points, const QMatrix4x4& m) {
  if (points.empty()) return;
  flat.bind();
  flat.setUniformValue("world_to_picture", m);
  flat_array.bind();
  flats.bind();
  flats.allocate(points.data(), static_cast<int>(points.size() * sizeof(points[0])));
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(points.size()));
  flat_array.release();
}

template <class Draw>
void GlPainter::State::draw_solid(QOpenGLShaderProgram& program, const SceneFigure& figure,
                                  const Scene& scene, QVector3D eye, const QMatrix4x4& m, bool shadow,
                                  QRgb shadow_color, Draw draw) {
  program.bind();
  program.setUniformValue("world_to_picture", m);
  program.setUniformValue("light", light);
  program.setUniformValue("eye", eye);
  program.setUniformValue("flattened", shadow);
  program.setUniformValue("flat_at", scene.floor);
  program.setUniformValue("flat_color", rgba_of(shadow_color));
  program.setUniformValue("opacity", figure.opacity);
  if (shadow) {
    // Every pixel of the floor is darkened once, however many bones are over it.
    draw();
    return;
  }
  if (figure.opacity >= 1) {
    draw();
    return;
  }
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw();
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthFunc(GL_LEQUAL);
  draw();
  glDepthFunc(GL_LESS);
}

void GlPainter::State::draw_figure(const SceneFigure& figure, const Scene& scene, QVector3D eye,
                                   const QMatrix4x4& m, bool shadow, QRgb shadow_color) {
  if (!figure.capsules.empty()) {
    std::vector<CapsuleInstance> all;
    all.reserve(figure.capsules.size());
    for (const SceneCapsule& c : figure.capsules)
      all.push_back({{c.a.x(), c.a.y(), c.a.z(), c.radius_a},
                     {c.b.x(), c.b.y(), c.b.z(), c.radius_b},
                     {static_cast<quint8>(qRed(c.color)), static_cast<quint8>(qGreen(c.color)),
                      static_cast<quint8>(qBlue(c.color)), 255}});
    capsule_array.bind();
    instances.bind();
    instances.allocate(all.data(), static_cast<int>(all.size() * sizeof(all[0])));
    draw_solid(capsule, figure, scene, eye, m, shadow, shadow_color, [&] {
      const auto start = static_cast<qintptr>(smooth_now ? coarse_corners * sizeof(quint16) : 0);
      glDrawElementsInstanced(GL_TRIANGLES, smooth_now ? fine_corners : coarse_corners, GL_UNSIGNED_SHORT,
                              reinterpret_cast<void*>(start), static_cast<GLsizei>(all.size()));
    });
    capsule_array.release();
  }
  if (figure.mesh) {
    const PosedMesh& skin = *figure.mesh;
    const int bytes = static_cast<int>(skin.positions.size() * sizeof(float));
    mesh_array.bind();
    mesh_points.bind();
    mesh_points.allocate(2 * bytes);
    mesh_points.write(0, skin.positions.data(), bytes);
    mesh_points.write(bytes, skin.normals.data(), bytes);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 12, nullptr);
    glEnableVertexAttribArray(1);
    glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, 12, reinterpret_cast<void*>(static_cast<qintptr>(bytes)));
    mesh_triangles.bind();
    mesh_triangles.allocate(skin.triangles.data(), static_cast<int>(skin.triangles.size() * sizeof(quint32)));
    mesh.bind();
    mesh.setUniformValue("mesh_color", rgba_of(figure.mesh_color));
    draw_solid(mesh, figure, scene, eye, m, shadow, shadow_color, [&] {
      glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(skin.triangles.size()), GL_UNSIGNED_INT, nullptr);
    });
    mesh_array.release();
  }
}

void GlPainter::State::draw_cell(const ScenePicture& picture, const SceneCell& cell) {
  const auto pixels = [&](const QRectF& part) {
    return QRectF(part.x() * picture.size.width(), part.y() * picture.size.height(),
                  part.width() * picture.size.width(), part.height() * picture.size.height())
        .toRect();
  };
  const QRect where = pixels(cell.where), clip = pixels(cell.clip);
  glViewport(where.x(), where.y(), where.width(), where.height());
  glScissor(clip.x(), clip.y(), clip.width(), clip.height());
  const QVector3D sky = rgb_of(picture.colors.sky);
  glClearColor(sky.x(), sky.y(), sky.z(), 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);

  const Scene& scene = cell.scene;
  const OrbitCamera camera = camera_of(picture, cell);
  // Upside down, because pictures in memory start at the top.
  QMatrix4x4 m;
  m.scale(1, -1, 1);
  m = m * camera.projection(where.size()) * camera.view();
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glEnable(GL_DEPTH_TEST);
  if (scene.has_floor) {
    draw_floor(picture, scene, camera, m);
    if (camera.eye().y() > scene.floor) {
      glDisable(GL_DEPTH_TEST);
      glEnable(GL_STENCIL_TEST);
      glStencilFunc(GL_EQUAL, 0, 0xff);
      glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);
      for (const SceneFigure& figure : scene.figures)
        if (figure.shadow) draw_figure(figure, scene, camera.eye(), m, true, picture.colors.shadow);
      glDisable(GL_STENCIL_TEST);
    }
    glDisable(GL_DEPTH_TEST);
    draw_flats(flat_marks(scene), m);
    glEnable(GL_DEPTH_TEST);
  }
  for (const SceneFigure& figure : scene.figures)
    if (figure.opacity >= 1) draw_figure(figure, scene, camera.eye(), m, false, 0);
  glDepthMask(GL_FALSE);
  draw_flats(flat_paths(scene, camera.eye()), m);
  glDepthMask(GL_TRUE);
  for (const SceneFigure& figure : scene.figures)
    if (figure.opacity < 1) draw_figure(figure, scene, camera.eye(), m, false, 0);
}

GlPainter::GlPainter() : state_(std::make_unique<State>()) {}
GlPainter::~GlPainter() = default;

QImage GlPainter::paint(const ScenePicture& picture) {
  QImage image(picture.size, QImage::Format_RGB32);
  if (image.isNull()) return image;
  State& gl = *state_;
  gl.smooth_now = picture.smooth;
  QOpenGLFramebufferObject& target = gl.target(picture.size, picture.smooth);
  target.bind();
  gl.glDisable(GL_SCISSOR_TEST);
  const QVector3D sky = rgb_of(picture.colors.sky);
  gl.glClearColor(sky.x(), sky.y(), sky.z(), 1);
  gl.glClear(GL_COLOR_BUFFER_BIT);
  gl.glEnable(GL_SCISSOR_TEST);
  for (const SceneCell& cell : picture.cells) gl.draw_cell(picture, cell);
  gl.glDisable(GL_SCISSOR_TEST);
  if (picture.smooth) {
    QOpenGLFramebufferObject& plain = gl.target(picture.size, false);
    QOpenGLFramebufferObject::blitFramebuffer(&plain, &target);
    plain.bind();
  }
  gl.glPixelStorei(GL_PACK_ALIGNMENT, 4);
  if (QOpenGLContext::currentContext()->isOpenGLES()) {
    QImage read(picture.size, QImage::Format_RGBA8888);
    gl.glReadPixels(0, 0, picture.size.width(), picture.size.height(), GL_RGBA, GL_UNSIGNED_BYTE,
                    read.bits());
    image = read.convertToFormat(QImage::Format_RGB32);
  } else {
    gl.glReadPixels(0, 0, picture.size.width(), picture.size.height(), GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV,
                    image.bits());
  }
  return image;
}

}  // namespace kinegraph
