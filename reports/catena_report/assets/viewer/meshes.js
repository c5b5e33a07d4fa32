// One triangle for each sphere or mark. The vertex shader reads its row of four floats and its four bytes of tint from
// textures, by its number: software renderers take an instance for a draw call of its own, 25 us each, and this is as
// quick for a device.

const textureWidth = 1024;

class DrawnTriangles {
  constructor(material) {
    this.material = material;
    this.mesh = new THREE.Mesh(new THREE.BufferGeometry(), material);
    this.mesh.frustumCulled = false;
    this.capacity = 0;
    this.rows = new Float32Array(0);
    this.tints = new Uint8Array(0);
    this.resize(0);
  }

  // New textures only when there are more triangles than before.
  resize(count) {
    if (count > this.capacity) {
      const height = Math.ceil(count / textureWidth);
      this.capacity = textureWidth * height;
      this.rows = new Float32Array(4 * this.capacity);
      this.tints = new Uint8Array(4 * this.capacity);
      // three.js draws as many corners as 'position' has; the shader reads nothing of it.
      this.mesh.geometry.dispose();
      this.mesh.geometry = new THREE.BufferGeometry();
      this.mesh.geometry.setAttribute('position', new THREE.BufferAttribute(new Uint8Array(3 * this.capacity), 1));
      const {rows, tints} = this.material.uniforms;
      for (const uniform of [rows, tints]) if (uniform.value) uniform.value.dispose();
      rows.value = new THREE.DataTexture(this.rows, textureWidth, height, THREE.RGBAFormat, THREE.FloatType);
      tints.value = new THREE.DataTexture(this.tints, textureWidth, height, THREE.RGBAFormat);
    }
    this.mesh.geometry.setDrawRange(0, 3 * count);
    this.mesh.visible = count > 0;
  }

  // After rows and tints were written.
  changed() {
    const {rows, tints} = this.material.uniforms;
    for (const uniform of [rows, tints]) if (uniform.value) uniform.value.needsUpdate = true;
  }

  // The shader tells the spheres of the pair chosen by this byte.
  chosen(instances) {
    for (const k of instances) if (k >= 0) this.tints[4 * k + 3] = 128;
  }
}

// Uniforms that every material shares: one object, so that they are set once a frame.
function sharedUniforms() {
  return {
    pixel: {value: 0.001},
    viewport: {value: new THREE.Vector2(1, 1)},
    depthRange: {value: new THREE.Vector2(-14, 1 / 28)},
    ground: {value: new THREE.Vector3()},
    haze: {value: new THREE.Vector2(1e9, 0)},
    contact: {value: new THREE.Vector4(0, 0, -1, 0)},
    contactFront: {value: 0},
    markSize: {value: 12},
  };
}

function sphereMaterial(shared, {translucent = 0, outline = 0, least = [0.8, 1.6], smooth = false, inTheWay = true}) {
  const uniforms = {
    ...shared, rows: {value: null}, tints: {value: null}, least: {value: new THREE.Vector2(...least)}, outline: {value: outline},
    translucent: {value: translucent}, flatness: {value: outline > 0 ? 1 : 0},
  };
  if (!inTheWay) uniforms.contactFront = {value: 0};
  return new THREE.ShaderMaterial({
    uniforms, vertexShader: sphereVertexShader, fragmentShader: sphereFragmentShader,
    defines: smooth ? {SMOOTH: 1} : {}, transparent: translucent > 0, depthWrite: translucent === 0,
  });
}

function markMaterial(shared) {
  return new THREE.ShaderMaterial({
    uniforms: {...shared, rows: {value: null}, tints: {value: null}}, vertexShader: markVertexShader, fragmentShader: markFragmentShader, transparent: true,
    depthWrite: false,
  });
}
