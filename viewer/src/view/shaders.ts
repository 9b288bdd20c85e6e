// GLSL of the picture. One attribute per frame holds the quanta of the displacement (xyz) and of the value (w).

const common = /* glsl */ `
precision highp float;
precision highp int;
uniform mat4 modelViewMatrix, projectionMatrix;
uniform vec3 uLow, uRange;  // of the displacement
uniform float uDeform;
in vec3 position;
in vec4 frame;
const float top = 65535.0 / 65534.0;
vec3 moved() { return position + uDeform * (uLow + uRange * (frame.xyz * top)); }
`;

/**
 * Faces. What is coloured and how is chosen when the shader is compiled, because software rendering pays for every branch:
 *   PLAIN, SPARSE or STATE   the looks of data/fields.ts; none of them: the colours of the parts alone
 *   ELEMENT                  the value is of the element (flat), otherwise of the nodes (smooth)
 */
export const faceVertex = /* glsl */ `${common}
in vec3 base;          // colour of the part
uniform vec2 uValue;   // low and range of the quanta
out vec3 vView;
flat out vec3 vBase;
#ifdef ELEMENT
flat out vec2 vValue;
#else
out vec2 vValue;       // the value, and 1 where there is none
#endif
void main() {
  vec4 view = modelViewMatrix * vec4(moved(), 1.0);
  vView = view.xyz;
  gl_Position = projectionMatrix * view;
  vBase = base;
  float none = frame.w > 65534.5 / 65535.0 ? 1.0 : 0.0;
  vValue = vec2((1.0 - none) * (uValue.x + uValue.y * frame.w * top), none);
}
`;

/** Texels of the table of colours. */
export const COLORS = 1024;

export const faceFragment = /* glsl */ `
precision highp float;
precision highp int;
uniform sampler2D uColors;
uniform vec2 uShown;   // range of the colours
in vec3 vView;
flat in vec3 vBase;
#ifdef ELEMENT
flat in vec2 vValue;
#else
in vec2 vValue;
#endif
out vec4 color;
vec3 shade() {
  float t = clamp((vValue.x - uShown.x) / max(uShown.y - uShown.x, 1e-30), 0.0, 1.0);
  return texelFetch(uColors, ivec2(int(t * ${COLORS - 1}.0 + 0.5), 0), 0).rgb;
}
void main() {
  vec3 normal = normalize(cross(dFdx(vView), dFdy(vView)));
  float light = 0.6 + 0.3 * abs(normal.z) + 0.12 * max(0.0, dot(normal, vec3(0.3522, 0.7547, 0.5535)));
#if defined(PLAIN)
  vec3 base = vValue.y > 0.5 ? vBase : shade();
#elif defined(SPARSE)
  vec3 base = mix(vBase, shade(), vValue.y > 0.5 ? 0.0 : smoothstep(0.0, 0.02, vValue.x / max(uShown.y, 1e-30)));
#elif defined(STATE)
  vec3 slides = vValue.x < 1.5 ? vec3(0.13, 0.45, 0.75) : vec3(0.93, 0.49, 0.13);
  vec3 base = vValue.y > 0.5 || vValue.x < 0.5 ? vBase : slides;
#else
  vec3 base = vBase;
#endif
  color = vec4(base * light, 1.0);
}
`;

/** Lines, points and highlighted faces: one colour. */
export const plainVertex = /* glsl */ `${common}
uniform float uSize, uForward;
void main() {
  gl_Position = projectionMatrix * (modelViewMatrix * vec4(moved(), 1.0));
  gl_Position.z -= uForward * gl_Position.w;
  gl_PointSize = uSize;
}
`;

export const plainFragment = /* glsl */ `
precision highp float;
uniform vec4 uColor;
uniform bool uRound;
out vec4 color;
void main() {
  if (uRound && dot(gl_PointCoord - 0.5, gl_PointCoord - 0.5) > 0.25) discard;
  color = uColor;
}
`;
