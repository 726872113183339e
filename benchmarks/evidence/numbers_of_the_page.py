"""Numbers of docs/notes/sources.md: for each row a text with a place per number, and where the numbers come from.

A value is `VERB[N]:PATH`, the number at a path of the JSON that the Nth command VERB of the row prints, or
`VERB:PATH/PATH`, a ratio; of a benchmark it is `bench:CASE|METRIC`. `scale` multiplies the numbers, `tolerance` (default
0.1) is the relative difference beyond which `evidence.py check` complains, and `slow` rows run only with --slow.
"""

RELATIVE = "picture.relMSE"
RMSE = "picture.rmse"
SHARE = "picture.rmse/picture.meanB"  # rms difference relative to the mean of the picture it is compared with


def against_paths(text, count=1, tolerance=0.1):
    """relMSE of the row's comparisons, in their order."""
    return {"text": text, "values": [f"compare{n}:{RELATIVE}" for n in range(1, count + 1)], "tolerance": tolerance}


def off(text, count=1):
    """rms difference as a share of the mean, in per cent."""
    return {"text": text, "values": [f"compare{n}:{SHARE}" for n in range(1, count + 1)], "scale": 100}


def accessibility(text, count=1):
    return {"text": text, "values": [f"compare{n}:{RMSE}" for n in range(1, count + 1)]}


NUMBERS = {
    # Kautz
    "sky-in-harmonics": {"text": "100 harmonics are {} % off the studio", "values": ["plot:harmonicsError"], "scale": 100},
    "sky-in-wavelets": {"text": "100 of 24,576 are {} % off the studio", "values": ["plot:waveletsError"], "scale": 100},
    "transfer": against_paths("relMSE {}"),
    "light-size": accessibility("balls of 0.05 m and 1.5 m: rmse {}"),
    "unshadowed": against_paths("relMSE {} unshadowed, {} by SH of order 6", 2),
    "interreflection": against_paths("relMSE {} with shadows alone, {} with three bounces", 2),
    "bumps": against_paths("relMSE {}, without bumps {}", 2),
    "glossy": {"text": "relMSE {}; Phong's lobe changes it by rmse {}",
               "values": [f"compare:{RELATIVE}", f"compare2:{RMSE}"]},
    "caustic-transfer": against_paths("relMSE {}, without {}", 2),
    "light-degrees": against_paths("0, 20 and 40 degrees: relMSE {}, {} and {}", 3),
    "bytes": {"text": "{} bytes per vertex, {} of the mean off",
              "values": ["info:baked.shCompressed.bytesPerVertex", f"compare:{SHARE}"]},
    "pca": off("{} % off with 16 axes"),
    "vq": off("{} % off with 256"),
    "cpca": off("{} % off with 4 axes, {} % with 8", 2),
    "keys": against_paths("relMSE {} between 9 keys"),
    "moving-occluders": against_paths("relMSE {} at 1.4 s, by the bake at rest"),
    "haar-terms": off("{} %, {} % and {} % off with 30, 100 and 300", 3),
    # Larsen
    "caustics-full": against_paths("relMSE {}"),
    "instant": against_paths("relMSE {}"),
    "path": {"text": "standard error {} of the mean", "values": ["reference:error"]},
    "rasterised-sum": against_paths("relMSE {} of the traced one"),
    "cornell-rasterised": against_paths("relMSE {}"),
    "coarse-texels": against_paths("relMSE {} with 1024, {} with 16,384", 2),
    # Real-time rendering
    "ao": accessibility("rmse {}"),
    "ao-corrections": accessibility("rmse {} with interreflection, {} without", 2),
    "ao-cubic": accessibility("rmse {}"),
    "fields": accessibility("rmse {}, GTAO {}", 2),
    "disks": accessibility("rmse {}"),
    "ssao": accessibility("rmse {}"),
    "hbao": accessibility("rmse {}"),
    "gtao": accessibility("rmse {}"),
    "light-groups": against_paths("relMSE {}; {} with the one bounce of the default", 2),
    # Sherif
    "phong-lobe": accessibility("rmse {} from GGX"),
    "glass-ball": against_paths("relMSE {}"),
    "radiosity": against_paths("relMSE {}"),
    "jacobi": {"text": "{} sweeps", "values": ["bake:radiosity.residuals[].sweeps"]},
    "gauss-seidel": {"text": "{} sweeps", "values": ["bake:radiosity.residuals[].sweeps"]},
    "southwell": {"text": "{} sweeps", "values": ["bake:radiosity.residuals[].sweeps"], "slow": True},
    "sherif-hbao": accessibility("rmse {} by SSAO, {} by HBAO", 2),
    "ssdo": against_paths("relMSE {}"),
    "bands": against_paths("relMSE {}, {}, {} with 2, 4 and 8 bands", 3),
    "ch": {"text": "rmse {}; by plain projection {} of the mean",
           "values": [f"compare:{RMSE}", f"compare2:{SHARE}"]},
    "wavelets-300": off("{} % off with 300 terms"),
    "vectors": {"text": "{} of 8 in `shapes`, {} in `caustics`",
                "values": ["info:baked.vo.stored", "info2:baked.vo.stored"]},
    "thesis-formula": against_paths("relMSE {}, by the soft formula {}", 2),
    "beside-radiosity": against_paths("relMSE {}, radiosity {}", 2),
    "beside-whitted": against_paths("relMSE {} with DS and SS, {} without", 2),
    "crowd": against_paths("relMSE {} VO, {} Phong", 2),
    "shapes-scene": {"text": "{} triangles, {} vertices", "values": ["info:contents.triangles", "info:contents.vertices"]},
    "under-a-sky": against_paths("relMSE {} VO, {} wavelets, {} SH of order 6, {} Phong, {} AO", 5),
    "sky-lights": {"text": "{} lights", "values": ["plot:lights"]},
    "grouping": against_paths("relMSE {}, a record per node {}", 2),
    "ocean-waves": accessibility("the waves change it by rmse {}"),
    "fire-lake": accessibility("fire and waves change it by rmse {}"),
    # Staniszewski
    "rgbe": {"text": "a range per band {} % off, `rgbe` {} %", "values": [f"compare:{SHARE}", f"compare2:{SHARE}"], "scale": 100},
    "key-error": {"text": "{} keys for an error of 0.1", "values": ["info:baked.animation.times"]},
}
