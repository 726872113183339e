// Stubs of the parts of Unity that the exported script uses, so that a compiler can check it as C#.
using System;
namespace UnityEngine.Rendering {
  public enum VertexAttribute { Position, TexCoord1 = 5 }
}
namespace UnityEngine {
  public class Object {}
  public class Component : Object { public T GetComponent<T>() where T : class { return null; } public T[] GetComponentsInChildren<T>() { return new T[0]; } }
  public class Behaviour : Component {}
  public class MonoBehaviour : Behaviour {}
  public class Texture : Object {}
  public class Texture2D : Texture {}
  public struct Vector4 { public Vector4(float x, float y, float z, float w) {} }
  public sealed class TooltipAttribute : Attribute { public TooltipAttribute(string t) {} }
  public sealed class LightmapData { public Texture2D lightmapColor { get; set; } public Texture2D lightmapDir { get; set; } }
  public enum LightmapsMode { NonDirectional, CombinedDirectional }
  public static class LightmapSettings { public static LightmapData[] lightmaps { get; set; } public static LightmapsMode lightmapsMode { get; set; } }
  public class Renderer : Component { public int lightmapIndex { get; set; } public Vector4 lightmapScaleOffset { get; set; } }
  public class MeshRenderer : Renderer {}
  public sealed class Mesh : Object { public bool HasVertexAttribute(Rendering.VertexAttribute attribute) { return false; } }
  public sealed class MeshFilter : Component { public Mesh sharedMesh { get; set; } }
}
