// Shows a light map that Prelight exported, in Unity: a component of the root of a scene that glTFast imported.
using UnityEngine;
using UnityEngine.Rendering;

public sealed class PrelightLightMap : MonoBehaviour
{
    [Tooltip("NAME.lightmap.exr, of texture type Lightmap")]
    public Texture2D lightMap;

    [Tooltip("NAME.lightmap.direction.png, of texture type Directional Lightmap; none: no bumps")]
    public Texture2D directions;

    private void Start()
    {
        var maps = LightmapSettings.lightmaps;
        var all = new LightmapData[maps.Length + 1];
        maps.CopyTo(all, 0);
        all[maps.Length] = new LightmapData { lightmapColor = lightMap, lightmapDir = directions };
        LightmapSettings.lightmaps = all;
        if (directions != null) LightmapSettings.lightmapsMode = LightmapsMode.CombinedDirectional;
        foreach (var drawn in GetComponentsInChildren<MeshRenderer>())
        {
            var filter = drawn.GetComponent<MeshFilter>();
            if (filter == null || filter.sharedMesh == null) continue;
            if (!filter.sharedMesh.HasVertexAttribute(VertexAttribute.TexCoord1)) continue;
            drawn.lightmapIndex = maps.Length;
            drawn.lightmapScaleOffset = new Vector4(1, 1, 0, 0);
        }
    }
}
