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

/** Faces. uMode 0: the value of the nodes, 1: of the element, 2: no colouring. uLook as in data/fields.ts: 0 plain, 1 sparse, 2 state. */
export const faceVertex = /* glsl */ `${common}
in float part;
uniform vec2 uValue;   // low and range of the quanta
out vec3 vView;
out float vSmooth, vGap;
flat out float vFlat, vPart;
void main() {
  vec4 view = modelViewMatrix * vec4(moved(), 1.0);
  vView = view.xyz;
  gl_Position = projectionMatrix * view;
  vGap = frame.w > 65534.5 / 65535.0 ? 1.0 : 0.0;
  vFlat = vGap > 0.5 ? -1e30 : uValue.x + uValue.y * frame.w * top;
  vSmooth = vGap > 0.5 ? 0.0 : vFlat;
  vPart = part;
}
`;

export const faceFragment = /* glsl */ `
precision highp float;
precision highp int;
uniform sampler2D uColors, uParts;
uniform vec2 uShown;   // range of the colours
uniform int uMode, uLook;
uniform float uBands;
in vec3 vView;
in float vSmooth, vGap;
flat in float vFlat, vPart;
out vec4 color;
void main() {
  vec3 normal = normalize(cross(dFdx(vView), dFdy(vView)));
  float facing = abs(normal.z);
  float light = 0.6 + 0.3 * facing + 0.12 * max(0.0, dot(normal, normalize(vec3(0.35, 0.75, 0.55))));
  vec3 base = texelFetch(uParts, ivec2(int(vPart + 0.5), 0), 0).rgb;
  bool gap = uMode == 2 || (uMode == 1 ? vFlat < -1e29 : vGap > 0.5);
  float value = uMode == 1 ? vFlat : vSmooth;
  if (!gap && uLook == 2) {
    if (value < 0.5) gap = true;
    else base = value < 1.5 ? vec3(0.13, 0.45, 0.75) : vec3(0.93, 0.49, 0.13);
  } else if (!gap) {
    float t = clamp((value - uShown.x) / max(uShown.y - uShown.x, 1e-30), 0.0, 1.0);
    if (uBands > 0.0) t = min(floor(t * uBands), uBands - 1.0) / (uBands - 1.0);
    vec3 shade = texture(uColors, vec2((t * 255.0 + 0.5) / 256.0, 0.5)).rgb;
    if (uLook == 1) shade = mix(base, shade, smoothstep(0.0, 0.02, value / max(uShown.y, 1e-30)));
    base = shade;
  }
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
