// Spheres drawn as what the eye sees of them: one triangle each, in which every pixel meets the exact sphere. One
// triangle instead of some hundred, round at any distance, and quick in software too.
//
// All lengths in the fragment are in units of the distance to the sphere's centre, so that nothing cancels, and the
// depth is the logarithm of the distance, so that a near speck and a far horn fit into one depth buffer.

const depthShader = `
  uniform vec2 depthRange;
  float depthOf(float distance) { return clamp((log2(distance) - depthRange.x) * depthRange.y, 0.0, 1.0); }
`;

// A triangle around the unit circle: fewer corners and half the triangles of a square.
const rowShader = `
  uniform highp sampler2D rows;
  uniform highp sampler2D tints;
  vec4 rowOf(highp sampler2D table) {
    int row = gl_VertexID / 3;
    return texelFetch(table, ivec2(row & 1023, row >> 10), 0);
  }
  vec2 cornerOf() {
    int corner = gl_VertexID % 3;
    return corner == 2 ? vec2(0.0, 2.0) : vec2(corner == 0 ? -1.7320509 : 1.7320509, -1.0);
  }
`;

const sphereVertexShader = rowShader + `
  uniform float pixel;       // width of a pixel at distance 1
  uniform vec2 least;        // least radius in pixels: of any sphere, of a marked one
  uniform float outline;     // pixels added to the radius
  uniform vec3 ground;
  uniform vec4 contact;      // the contact chosen, in the camera's space, and its reach
  uniform float contactFront;   // what is nearer than this, and before the contact, is drawn as a rim only
  varying vec2 corner;
  flat varying vec4 shape;   // radius / distance, its square, slope of the silhouette, distance
  flat varying float hollow; // up to what share of the radius nothing is drawn
  flat varying vec3 light;
  flat varying vec3 colour;
  void main() {
    vec4 sphere = rowOf(rows), tint = rowOf(tints);
    vec3 centre = (modelViewMatrix * vec4(sphere.xyz, 1.0)).xyz;
    float distance = length(centre);
    float size = distance * pixel;   // of a pixel, there
    float visible = max(sphere.w, size * (tint.a > 0.4 ? least.y : least.x));
    float radius = visible + outline * size;
    hollow = outline > 0.0 ? visible / radius : 0.0;
    bool chosen = abs(tint.a - 0.5) < 0.1;
    if (!chosen && distance < contactFront) {
      vec3 beside = centre - contact.xyz * (dot(centre, contact.xyz) / dot(contact.xyz, contact.xyz));
      float width = contact.w * distance / length(contact.xyz);
      bool before = length(beside) < radius + width;
      // Far before the contact nothing is drawn, so that a contact deep inside is seen like one outside.
      if (distance < (before ? 0.88 : 0.68) * contactFront) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
      if (before) hollow = max(1.0 - 1.5 * size / radius, 0.0);
    }
    float k = radius / distance;
    if (!(k < 0.9995) || distance > 1e15) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
    vec3 away = centre / distance;
    vec3 right = normalize(cross(away, abs(away.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
    vec3 up = cross(right, away);
    float slope = k * inversesqrt(1.0 - k * k);
    corner = cornerOf();
    shape = vec4(k, k * k, slope, distance);
    vec3 lamp = normalize(vec3(-0.45, 0.75, 0.6));
    light = vec3(dot(lamp, right), dot(lamp, up), dot(lamp, away));
    colour = chosen || contactFront <= 0.0 ? tint.rgb : mix(tint.rgb, ground, 0.35);
    gl_Position = projectionMatrix * vec4((away + (right * corner.x + up * corner.y) * slope) * distance, 1.0);
    gl_Position.z = 0.0;
  }
`;

const sphereFragmentShader = depthShader + `
  uniform vec3 ground;
  uniform vec2 haze;         // distance where it begins, and what it grows by
  uniform float translucent;
  uniform float flatness;
  varying vec2 corner;
  flat varying vec4 shape;
  flat varying float hollow;
  flat varying vec3 light;
  flat varying vec3 colour;
  void main() {
    vec2 tangent = corner * shape.z;
    float square = dot(tangent, tangent);
    float cosine = inversesqrt(1.0 + square);
    float inside = shape.y - square * cosine * cosine;
    #ifdef SMOOTH
    float coverage = clamp(inside / fwidth(inside), 0.0, 1.0);
    #else
    float coverage = 1.0;
    #endif
    if (inside < 0.0 || coverage <= 0.0 || inside > shape.y * (1.0 - hollow * hollow)) discard;
    float hit = cosine - sqrt(inside);
    float distance = hit * shape.w;
    vec3 normal = vec3(tangent * cosine * hit, cosine * hit - 1.0) / shape.x;
    float facing = clamp(-normal.z, 0.0, 1.0);
    if (flatness > 0.0) {      // an outline: behind the sphere that it surrounds
      gl_FragColor = vec4(colour, coverage);
      gl_FragDepth = depthOf(shape.w);
      return;
    }
    gl_FragDepth = depthOf(distance);
    if (translucent > 0.0) {
      float rim = 1.0 - facing;
      gl_FragColor = vec4(colour, translucent * (0.04 + 0.96 * rim * rim * rim * rim));
      return;
    }
    float wrapped = dot(normal, light) * 0.5 + 0.5;
    vec3 lit = colour * (0.42 + 0.66 * wrapped) * (0.72 + 0.28 * facing);
    lit += 0.16 * pow(wrapped, 24.0);
    float fog = clamp((distance - haze.x) * haze.y, 0.0, 0.4);
    gl_FragColor = vec4(mix(lit, ground, fog), coverage);
  }
`;

// Marks of one size on the screen, at contacts: a ring, a diamond (missing), a cross (invented). A ring gives way to
// the coloured spheres once they are large enough to be seen.
//
// A row holds the contact's place and the smaller radius; its tint's alpha is 0 for a ring, 0.5 diamond, 1 cross.
const markVertexShader = rowShader + `
  uniform float pixel;
  uniform vec2 viewport;
  uniform float markSize;
  uniform float contactFront;
  varying vec2 corner;
  flat varying vec4 colour;
  flat varying vec2 mark;    // kind, distance
  void main() {
    vec4 contact = rowOf(rows), tint = rowOf(tints);
    vec3 centre = (modelViewMatrix * vec4(contact.xyz, 1.0)).xyz;
    float distance = length(centre);
    float seen = contact.w / (distance * pixel);
    float strength = tint.a < 0.25 ? 1.0 - smoothstep(1.2, 3.5, seen) : 1.0;
    float size = tint.a < 0.25 ? 9.0 : markSize;
    // With a pair chosen its own mark counts, and those before it would be in the way.
    if (contactFront > 0.0 && distance < 0.8 * contactFront) strength = 0.0;
    corner = cornerOf() * 1.25;
    colour = vec4(tint.rgb, strength);
    // Always in front, unless a pair is chosen: then where it is.
    mark = vec2(tint.a, tint.a > 0.25 && contactFront <= 0.0 ? 0.0 : max(distance - 2.5 * contact.w, distance * 0.5));
    gl_Position = projectionMatrix * vec4(centre, 1.0);
    gl_Position.xy += corner * size * 2.0 / viewport * gl_Position.w;
    gl_Position.z = 0.0;
    if (strength <= 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  }
`;

const markFragmentShader = depthShader + `
  uniform vec3 ground;
  varying vec2 corner;
  flat varying vec4 colour;
  flat varying vec2 mark;
  void main() {
    vec2 p = abs(corner);
    float line = abs(length(corner) - 0.8);
    if (mark.x > 0.25) line = abs(p.x + p.y - 0.95) * 0.75;
    if (mark.x > 0.75) line = max(abs(p.x - p.y) * 0.75, max(p.x, p.y) - 0.75);
    float ink = 1.0 - smoothstep(0.1, 0.2, line);
    float halo = 1.0 - smoothstep(0.24, 0.36, line);
    if (halo <= 0.0) discard;
    gl_FragColor = vec4(mix(ground, colour.rgb, ink), colour.a * max(ink, 0.75 * halo));
    gl_FragDepth = mark.y > 0.0 ? depthOf(mark.y) : 0.0;
  }
`;
