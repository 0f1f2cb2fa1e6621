"""The blocks of limits and of search settings."""

from __future__ import annotations

from typing import Literal, Self

from pydantic import Field, model_validator

from .base import Block, Number, Whole, wrong


class UnwrappingBlock(Block):
    """Whether the phase can be unwrapped, given a height known beforehand."""

    prior_height_std_m: Number = Field(
        ge=0.01,
        le=1000,
        description="Standard deviation of the prior height, an existing DEM: 2 to 10.",
    )
    min_probability: Number | None = Field(
        default=0.99,
        ge=0.01,
        le=0.999999,
        description="Smallest probability, in every segment, that all cycles are found; null: "
        "reported, not limited.",
    )


class LimitsBlock(Block):
    """Limits of a formation; each is off unless it is given."""

    max_radius_over_critical_baseline: Number | None = Field(
        default=None,
        gt=0,
        le=10,
        description="Largest radius of each relative orbit, in parts of the smallest critical "
        "baseline of the scene.",
    )
    max_radius_m: Number | None = Field(
        default=None,
        ge=1,
        le=40_000,
        description="Largest radius of each relative orbit; of this and the limit in critical "
        "baselines the smaller one counts.",
    )
    min_separation_m: Number | None = Field(
        default=None,
        ge=0.1,
        le=40_000,
        description="Smallest distance of every pair of satellites at all times.",
    )
    unwrapping: UnwrappingBlock | None = Field(
        default=None, description="Probability that the phase is unwrapped rightly."
    )
    max_baseline_over_critical_baseline: Number | None = Field(
        default=None,
        gt=0,
        le=10,
        description="Largest perpendicular baseline of each pair, in parts of its own critical "
        "baseline.",
    )
    max_z0_m: Number | None = Field(
        default=None,
        ge=0.1,
        le=20_000,
        description="Largest radial offset |z0|; also the box of the search.",
    )
    max_zdot0_m_s: Number | None = Field(
        default=None,
        ge=0.0001,
        le=30,
        description="Largest radial rate |zdot0|; also the box of the search.",
    )


class SearchLimitsBlock(LimitsBlock):
    """Limits that the search keeps; null switches one off."""

    max_radius_over_critical_baseline: Number | None = Field(
        default=0.5,
        gt=0,
        le=10,
        description="Largest radius of each relative orbit, in parts of the smallest critical "
        "baseline of the scene; null: off.",
    )
    min_separation_m: Number | None = Field(
        default=100.0,
        ge=0.1,
        le=40_000,
        description="Smallest distance of every pair of satellites at all times; null: off.",
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        radius = (self.max_radius_over_critical_baseline, self.max_radius_m)
        if radius == (None, None) and (self.max_z0_m is None or self.max_zdot0_m_s is None):
            raise wrong(
                (),
                "bounds neither the radius nor both z0 and zdot0, so the search has no end",
                "add max_radius_over_critical_baseline: 0.5, or max_z0_m and max_zdot0_m_s",
            )
        return self


_GENETIC_KEYS = (
    "crossover_probability",
    "crossover_eta",
    "mutation_probability",
    "mutation_eta",
    "tournament",
    "elite",
)


class SearchBlock(Block):
    """The populations that search, and the refinement of the best designs."""

    method: Literal["genetic", "differential_evolution", "cma_es"] = Field(
        default="genetic",
        description="Algorithm of the populations: genetic (DEAP), differential_evolution or "
        "cma_es (DEAP).",
    )
    population: Whole = Field(
        default=40, ge=4, le=10_000, description="Formations of a generation, on each island."
    )
    generations: Whole = Field(
        default=25, ge=1, le=100_000, description="Generations after the first."
    )
    seed: Whole = Field(
        default=1,
        ge=0,
        le=2**32 - 1,
        description="Seed of the random numbers; the same seed gives the same result.",
    )
    refinements: Whole = Field(
        default=6,
        ge=0,
        le=1000,
        description="How many of the best, mutually distant designs are refined; 0 for none.",
    )
    structured_starts: Whole = Field(
        default=8,
        ge=0,
        le=100,
        description="How many structured designs (dumbbells and ladders) are refined besides, so "
        "that the result depends less on luck; 0 for none.",
    )
    islands: Whole = Field(
        default=1, ge=1, le=100, description="Populations that search side by side."
    )
    migration_interval: Whole = Field(
        default=10,
        ge=1,
        le=100_000,
        description="Generations after which the best of each island reaches the next; CMA-ES "
        "takes in none.",
    )
    restart: bool = Field(
        default=True,
        description="Whether a population whose designs have become alike begins anew.",
    )
    crossover_probability: Number = Field(
        default=0.9, ge=0, le=1, description="Probability that a pair of parents is crossed."
    )
    crossover_eta: Number = Field(
        default=10.0,
        ge=0,
        le=1000,
        description="Crowding of simulated binary crossover: the larger, the closer to parents.",
    )
    mutation_probability: Number = Field(
        default=0.2, ge=0, le=1, description="Probability that a variable is mutated."
    )
    mutation_eta: Number = Field(
        default=20.0,
        ge=0,
        le=1000,
        description="Crowding of polynomial mutation: the larger, the smaller the step.",
    )
    tournament: Whole = Field(
        default=2, ge=1, le=1000, description="Formations that compete to become a parent."
    )
    elite: Whole = Field(
        default=1, ge=0, le=1000, description="Best formations that survive unchanged."
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.method != "genetic":
            for key in _GENETIC_KEYS:
                if key in self.model_fields_set:
                    raise wrong(
                        (key,),
                        f"is a setting of the genetic algorithm, and method is {self.method}",
                        "remove this key, or set method: genetic",
                    )
        if self.method == "differential_evolution" and self.population < 5:
            raise wrong(
                ("population",),
                "must be at least 5 for differential_evolution, which combines four members",
                "raise the population",
            )
        if self.elite >= self.population:
            raise wrong(
                ("elite",),
                f"must be below the population, {self.population}",
                "let fewer survive or raise the population",
            )
        return self
