"""Every scheme that a user can name, as the keys of `time` and the options that ask for it."""


class Method:
    """@param adaptive  whether its steps follow the motion, so that the first one alone is given"""

    def __init__(self, key, name, options=(), **time_keys):
        self.key, self.name, self.options, self.time_keys = key, name, options, time_keys
        self.adaptive = "adaptive" in time_keys

    def asked(self, made, step):
        """The scene with this scheme and step, and the accounts of energy that tell what a scheme brings in."""
        output = {**made["output"], "energy": True}
        return {**made, "time": {**made["time"], "step": step, **self.time_keys}, "output": output}


ALL = {method.key: method for method in (
    Method("default", "default"),
    Method("conserving", "energy_momentum,\nnothing removed", scheme="energy_momentum"),
    Method("radius_0.9", "energy_momentum,\nradius 0.9", spectral_radius=0.9),
    Method("radius_0.5", "energy_momentum,\nradius 0.5", spectral_radius=0.5),
    Method("radius_0", "energy_momentum,\nradius 0", spectral_radius=0),
    Method("secant", "default,\nsecant tangent", ("-cable_tangent", "secant")),
    Method("averaged_1", "generalized_alpha,\nradius 1", scheme="generalized_alpha", spectral_radius=1),
    Method("averaged_0.8", "generalized_alpha,\nradius 0.8", scheme="generalized_alpha", spectral_radius=0.8),
    Method("averaged_0.5", "generalized_alpha,\nradius 0.5", scheme="generalized_alpha", spectral_radius=0.5),
    Method("averaged_0", "generalized_alpha,\nradius 0", scheme="generalized_alpha", spectral_radius=0),
    Method("plain_0.8", "plain,\nradius 0.8", scheme="plain", spectral_radius=0.8),
    Method("plain_0", "plain,\nradius 0", scheme="plain", spectral_radius=0),
    Method("adaptive_1e-3", "default,\nadaptive 1e-3 m", adaptive={"tolerance": 1e-3}),
    Method("adaptive_1e-4", "default,\nadaptive 1e-4 m", adaptive={"tolerance": 1e-4}),
)}
