// What the replay uses of three.js; `npm ci && npm run build` in the folder above makes three.min.js of it.
export {
  Box3, BufferGeometry, Color, Curve, CylinderGeometry, ConeGeometry, DirectionalLight, Group, HemisphereLight,
  AnimationMixer, LoopOnce, Mesh, MeshBasicMaterial, MeshStandardMaterial, PCFSoftShadowMap, PerspectiveCamera,
  Quaternion, REVISION, Scene, SphereGeometry, TubeGeometry, Vector3, WebGLRenderer,
} from "three";
export { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
export { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
