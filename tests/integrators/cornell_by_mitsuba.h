#pragma once

#include <array>
#include <glm/glm.hpp>

namespace prelight::test {

/// The built-in scene `cornell` rendered by Mitsuba 3, which shares nothing with Prelight. Values are the
/// mean radiance of 8 x 8 blocks, row by row from the upper left, of a picture of 48 x 48 pixels. It was made
/// from `prelight scene cornell -o cornell.glb` with the integrator `path` (llvm_ad_rgb, max_depth 17,
/// rr_depth 8), 4096 samples per pixel, box filter, one-sided lamp, and Lambert's law on the walls.
inline constexpr int cornellBlocks = 8, cornellPixels = 48;
inline const std::array<glm::vec3, cornellBlocks * cornellBlocks> cornellByMitsuba{{
    glm::vec3{0.04893f, 0.01258f, 0.00332f}, glm::vec3{0.07724f, 0.03366f, 0.00934f},
    glm::vec3{0.08144f, 0.04195f, 0.01159f}, glm::vec3{0.49316f, 0.34000f, 0.11053f},
    glm::vec3{0.50002f, 0.35059f, 0.11331f}, glm::vec3{0.06191f, 0.04685f, 0.01081f},
    glm::vec3{0.05243f, 0.04405f, 0.00921f}, glm::vec3{0.02363f, 0.02529f, 0.00372f},
    glm::vec3{0.11662f, 0.00848f, 0.00193f}, glm::vec3{0.13330f, 0.03293f, 0.00923f},
    glm::vec3{0.13949f, 0.07171f, 0.02086f}, glm::vec3{2.97970f, 2.09150f, 0.69372f},
    glm::vec3{2.95489f, 2.08578f, 0.69035f}, glm::vec3{0.09238f, 0.07433f, 0.01728f},
    glm::vec3{0.05275f, 0.06354f, 0.00887f}, glm::vec3{0.02679f, 0.05501f, 0.00344f},
    glm::vec3{0.15669f, 0.01153f, 0.00271f}, glm::vec3{0.21063f, 0.03666f, 0.01050f},
    glm::vec3{0.21254f, 0.12013f, 0.03730f}, glm::vec3{0.28065f, 0.18351f, 0.05709f},
    glm::vec3{0.25629f, 0.18130f, 0.05449f}, glm::vec3{0.16570f, 0.12754f, 0.03480f},
    glm::vec3{0.07016f, 0.10278f, 0.01206f}, glm::vec3{0.03677f, 0.07680f, 0.00495f},
    glm::vec3{0.14683f, 0.01073f, 0.00252f}, glm::vec3{0.21070f, 0.03979f, 0.01176f},
    glm::vec3{0.17372f, 0.09150f, 0.02828f}, glm::vec3{0.20538f, 0.13984f, 0.04279f},
    glm::vec3{0.25932f, 0.18830f, 0.05607f}, glm::vec3{0.19114f, 0.15008f, 0.04113f},
    glm::vec3{0.07997f, 0.11264f, 0.01442f}, glm::vec3{0.03572f, 0.07490f, 0.00482f},
    glm::vec3{0.12372f, 0.00891f, 0.00208f}, glm::vec3{0.15038f, 0.02978f, 0.00895f},
    glm::vec3{0.09556f, 0.04286f, 0.01269f}, glm::vec3{0.09440f, 0.06590f, 0.01890f},
    glm::vec3{0.19043f, 0.14505f, 0.04131f}, glm::vec3{0.15947f, 0.13040f, 0.03462f},
    glm::vec3{0.06968f, 0.09862f, 0.01281f}, glm::vec3{0.03035f, 0.06442f, 0.00408f},
    glm::vec3{0.10207f, 0.00720f, 0.00167f}, glm::vec3{0.06061f, 0.00882f, 0.00236f},
    glm::vec3{0.06916f, 0.03032f, 0.00894f}, glm::vec3{0.07589f, 0.04705f, 0.01388f},
    glm::vec3{0.10511f, 0.07367f, 0.02219f}, glm::vec3{0.09914f, 0.07462f, 0.02132f},
    glm::vec3{0.04968f, 0.07895f, 0.00887f}, glm::vec3{0.02240f, 0.04985f, 0.00302f},
    glm::vec3{0.09087f, 0.00618f, 0.00145f}, glm::vec3{0.04813f, 0.00967f, 0.00268f},
    glm::vec3{0.07776f, 0.03796f, 0.01183f}, glm::vec3{0.10139f, 0.06278f, 0.01977f},
    glm::vec3{0.02260f, 0.01141f, 0.00352f}, glm::vec3{0.01355f, 0.00860f, 0.00203f},
    glm::vec3{0.07786f, 0.08956f, 0.01588f}, glm::vec3{0.01679f, 0.04063f, 0.00234f},
    glm::vec3{0.09663f, 0.03537f, 0.01099f}, glm::vec3{0.14654f, 0.08444f, 0.02693f},
    glm::vec3{0.16457f, 0.10062f, 0.03236f}, glm::vec3{0.15913f, 0.10061f, 0.03252f},
    glm::vec3{0.04411f, 0.02536f, 0.00783f}, glm::vec3{0.02477f, 0.01612f, 0.00417f},
    glm::vec3{0.03066f, 0.03307f, 0.00576f}, glm::vec3{0.04408f, 0.04621f, 0.00912f},
}};

}  // namespace prelight::test
